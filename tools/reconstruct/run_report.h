// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is before and after a run: its input, which is made of the cloud of a file; its report as JSON, as
// text, and as a page; and its exit code.
#pragma once

#include "command_line.h"
#include "scratch_arrays.h"

#include <pcl/surface/floater/reconstruct.h>
#include <pcl/surface/floater/vertex_normals.h>

#include <nlohmann/json_fwd.hpp>
#include <sys/resource.h>
#include <sys/vfs.h>

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

/// What is wrong with degrees beside metres.
constexpr const char* DEGREES = "x and y seem to be degrees of longitude and latitude, and z "
                                "metres: distances make no sense so";

/// \param kept_per_point see leastMemory
/// \throws UsageError if so many points cannot be kept below the limit
inline void
checkMemory (const CommandLine& line, std::size_t points, double kept_per_point = KEPT_PER_POINT)
{
  const std::size_t least = leastMemory (points, kept_per_point);
  if (line.max_memory > 0 && line.max_memory < least)
    throw UsageError ("--max-memory: " + formatSize (line.max_memory) + " is too small for " +
                      counted (points, "point") + "; use " + formatSize (least) + " or more");
}

/// Makes the input of the core of a cloud: the positions of the points that are not left out, normals
/// if the command line uses them, and its origin where that asks for it, or where floats are too
/// coarse; the viewpoint of the line is moved as well. Warns of degrees beside metres. All other
/// fields stay in the file.
/// \param[out] figures what is known of the cloud
/// \param kept_per_point see leastMemory
/// \throws UsageError if there is too little memory, or if the cloud lacks normals
Input
prepareInput (CommandLine& line, Cloud& cloud, RunFigures& figures,
              double kept_per_point = KEPT_PER_POINT);

/// Gives the cloud the fields nx, ny and nz of 32-bit floats, with the normals of the vertices of
/// the mesh (see vertexNormals ()), in place of those that it has. All points must be left.
inline void
replaceNormals (Cloud& cloud, const Triangles& triangles, int threads)
{
  std::vector<Eigen::Vector3f> normals = vertexNormals (cloud.positions (), triangles, threads);
  giveBackMappedFiles ();
  replaceColumns ({"nx", "ny", "nz"}, ScalarType::FLOAT32, std::move (normals), cloud.fields);
}

inline int
exitCode (const Report& report, const RunFigures& run)
{
  const RunStatus status = report.status;
  return run.is_refused                        ? EXIT_WARNINGS
         : status == RunStatus::SUCCESS        ? EXIT_OK
         : status == RunStatus::INVALID_OPTION ? EXIT_USAGE
         : status == RunStatus::OUT_OF_MEMORY || status == RunStatus::INTERNAL_ERROR
             ? EXIT_INTERNAL
             : EXIT_RECONSTRUCTION;
}

/// Adds to the report the warnings on the input, those on options, and what went wrong with the memory
/// limit and the scratch folder.
inline void
completeReport (const CommandLine& line, const std::vector<std::string>& of_input, Report& report)
{
  report.warnings.insert (report.warnings.begin (), line.warnings.begin (), line.warnings.end ());
  report.warnings.insert (report.warnings.begin (), of_input.begin (), of_input.end ());
  if (const std::string failure = scratchFailure ();
      report.status == RunStatus::OUT_OF_MEMORY && !failure.empty ())
    report.message = failure;
  if (line.max_memory == 0)
    return;
  constexpr unsigned long TMPFS = 0x01021994UL, RAMFS = 0x858458f6UL; // kept in memory
  struct statfs status = {};
  const bool is_known = ::statfs (line.scratch.c_str (), &status) == 0;
  const auto type = static_cast<unsigned long> (status.f_type);
  if (is_known && (type == TMPFS || type == RAMFS))
    report.warnings.push_back ("the scratch folder '" + line.scratch.string () +
                               "' is in memory itself; use --scratch to name one on a disk");
  const std::size_t peak = peakMemory ();
  if (peak > line.max_memory)
    report.warnings.push_back ("the memory in use grew to " + formatSize (peak) +
                               ", above --max-memory " + formatSize (line.max_memory));
}

nlohmann::ordered_json
reportJson (const CommandLine& line, const Report& report, const RunFigures& run);

/// The same as text, with one line for each of its keys.
std::string
reportText (const CommandLine& line, const Report& report, const RunFigures& run);

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
