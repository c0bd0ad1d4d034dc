// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the core knows of a run, as JSON: the parts of a report that the tool and the Python module
// share.
#pragma once

#include "format.h"

#include <pcl/surface/floater/report.h>

#include <nlohmann/json_fwd.hpp>

namespace pcl::floater {
/// JSON as text. It is UTF-8; in names of files, bytes that are not are replaced.
/// \param indent -1: all on one line
std::string
dump (const nlohmann::ordered_json& json, int indent = -1);

/// The options of a run, by the names of the tool.
nlohmann::ordered_json
optionsJson (const Options& options, bool use_input_normals);

/// The table of options: an array with name, letter, group, class, kind (bool, int, float, word, place), default,
/// values and text of each.
/// \param options whose values are the defaults
nlohmann::ordered_json
optionTableJson (const Options& options = {});

/// Null if the mesh is not that of a single scan.
nlohmann::ordered_json
viewpointJson (const Report& report);

/// The method, what the mesh is, what is not sure about it, and the figures: all but the outcome,
/// the times, and the lists of points.
nlohmann::ordered_json
resultJson (const Report& report);

/// Why a mesh is refused where that is asked for: it is poor, or points are in no triangle. Empty if
/// there is no reason.
inline std::string
objectionTo (const Report& report)
{
  const std::size_t unused = report.unused.size ();
  if (report.status != RunStatus::SUCCESS)
    return "";
  if (report.verdict.value == Quality::POOR)
    return "the mesh is poor: " + report.verdict.cause;
  return unused == 0
             ? ""
             : counted (unused, "point") + (unused == 1 ? " is" : " are") + " in no triangle";
}

nlohmann::ordered_json
secondsJson (const Statistics& statistics);

} // namespace pcl::floater
