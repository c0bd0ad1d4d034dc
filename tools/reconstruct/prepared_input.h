// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From a cloud of a file to the input of the core; and from its outcome to an exit code.
#pragma once

#include "run_report.h"
#include "scratch_arrays.h"

#include <pcl/surface/floater/vertex_normals.h>

namespace pcl::floater {
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

} // namespace pcl::floater
