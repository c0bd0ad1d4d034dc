// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From a cloud of a file to the input of the core; and from its outcome to an exit code.
#pragma once

#include "run_report.h"
#include "scratch_arrays.h"

namespace pcl::floater {
/// What is wrong with degrees beside metres.
constexpr const char* DEGREES = "x and y seem to be degrees of longitude and latitude, and z "
                                "metres: distances make no sense so";

/// \param kept_per_point see leastMemory
/// \throws UsageError if so many points cannot be kept below the limit
void
checkMemory (const CommandLine& line, std::size_t points, double kept_per_point = KEPT_PER_POINT);

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
void
replaceNormals (Cloud& cloud, const Triangles& triangles, int threads);

int
exitCode (const Report& report, const RunFigures& run);

} // namespace pcl::floater
