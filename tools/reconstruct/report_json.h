// SPDX-License-Identifier: GPL-3.0-or-later
// What a run tells about itself, as JSON.
#pragma once

#include "cloud.h"
#include "command_line.h"

#include <pcl/surface/floater/report.h>

#include <string>

namespace pcl
{
namespace floater
{
/// A run as the tool sees it.
struct RunFigures
{
  std::size_t input_points = 0;
  std::vector<std::string> input_fields; ///< other than the coordinates
  bool single_precision = true;          ///< of the coordinates
  std::size_t vertices = 0;              ///< in the output
  bool is_refused = false;               ///< no mesh is written because of warnings
  double read_seconds = 0.0;
  double reconstruct_seconds = 0.0;
  double write_seconds = 0.0;
};

/// Largest resident memory of this process so far, in bytes.
std::size_t
peakMemory ();

/// Name of the outcome: that of the status, or "WARNINGS" if the mesh is refused because of these.
std::string
outcomeName (const Report& report, const RunFigures& run);

/// The whole report; one line for each entry of the outermost object.
std::string
reportText (const CommandLine& command_line, const Report& report, const RunFigures& run);

/// The most important figures in one line without newline.
std::string
summaryLine (const CommandLine& command_line, const Report& report, const RunFigures& run);

} // namespace floater
} // namespace pcl
