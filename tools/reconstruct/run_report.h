// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The report of the tool on a run, as JSON, as text, and as a page.
#pragma once

#include "command_line.h"

#include <pcl/surface/floater/reconstruct.h>

#include <nlohmann/json_fwd.hpp>
#include <sys/resource.h>

#include <chrono>

namespace pcl::floater {
/// Figures of a run that the core does not know.
struct RunFigures
{
  std::size_t input_points = 0;
  std::vector<std::string> notes;        ///< on the input, as Cloud has them
  std::vector<std::string> input_fields; ///< fields of the points but the coordinates
  bool writes_single = true;             ///< whether those of the mesh are
  bool single_precision = true;          ///< whether the coordinates are 32-bit floats
  std::array<double, 3> shift{};         ///< subtracted from all coordinates
  std::size_t vertices = 0;              ///< vertices of the output
  bool is_refused = false;               ///< --strict: no mesh is written, see objectionTo
  double read_seconds = 0.0;
  double reconstruct_seconds = 0.0;
  double write_seconds = 0.0;
  double texture_seconds = 0.0;
  TextureCoordinates texture{}; ///< its figures; NOT_RUN if none was asked for
};

inline double
secondsSince (std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double> (std::chrono::steady_clock::now () - start).count ();
}

/// Largest resident memory of this process so far, in bytes.
inline std::size_t
peakMemory ()
{
  constexpr std::size_t UNIT = 1024; // bytes; Linux counts in kB
  rusage usage{};
  ::getrusage (RUSAGE_SELF, &usage);
  return static_cast<std::size_t> (usage.ru_maxrss) * UNIT;
}

/// Adds to the report the warnings on the input, those on options, and what went wrong with the memory
/// limit and the scratch folder.
void
completeReport (const CommandLine& line, const std::vector<std::string>& of_input, Report& report);

nlohmann::ordered_json
reportJson (const CommandLine& command_line, const Report& report, const RunFigures& run);

/// The same as text, with one line for each of its keys.
std::string
reportText (const CommandLine& command_line, const Report& report, const RunFigures& run);

/// The report as one page of HTML that refers to nothing outside: outcome, figures, histograms,
/// findings and uncertain decisions with their places, and the mesh, drawn by WebGL. All that
/// depends on the run is in one JSON text, which holds the report of reportJson () without its lists
/// of points. Meshes of more than CommandLine::shown_triangles are thinned, but for triangles with
/// flaws. O(n log n); takes 200 bytes per point, and the text up to 24 MB.
/// \param cloud  the cloud, from which points without finite coordinates may have been removed
/// \param result its triangles are indices into the cloud; none: the points are shown
std::string
htmlReport (const CommandLine& line, const Cloud& cloud, const Result& result,
            const RunFigures& run);

/// Prints errors and warnings to the standard error stream, the summary and the line of --json to
/// the standard output. Comes before any output file is visible: if nothing can be printed, no file
/// has been changed.
/// \throws WriteError if the standard output fails
void
printOutcome (const CommandLine& line, const Report& report, const RunFigures& figures);

} // namespace pcl::floater
