// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of the points by least-squares planes (TW 385, section 4.1).
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/rows.h"

#include <vector>

namespace pcl::floater {
/// Thresholds for the sheet of a point. The first two were chosen on the clouds of the first
/// benchmark, and are fragile: a fifth more or less of either costs 2 to 4 of 18 clean clouds there
/// (test/benchmark/flaws.py shows the effect of changes).
struct PlaneLimits
{
  std::size_t core_points = 8; ///< nearest neighbours of the first plane: about the first ring of
                               ///< an even sampling, and a little more
  double sheet_sine = 0.5;     ///< of the angle, 30 degrees, between the first plane and a
                               ///< neighbour of the second fit
  double least_aspect = 0.05;  ///< of the points of the first plane (see Plane::aspect); neighbours
                               ///< are added until it is reached. Points on a line with noise of
                               ///< one step are below, a third of an evenly sampled disc is above
};

/// Unit normals, of arbitrary sign: planes through the 8 nearest neighbours, refitted to all
/// neighbours near that plane, so that a second sheet within reach does not tilt them. If the 8
/// nearest are nearly collinear, as in scan lines, more are used. O(n k).
/// \param neighbors of the points in `rows`, nearest first
/// \param rows      points to compute; others are zero
std::vector<Eigen::Vector3f>
fitTangentPlanes (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  const Rows& rows, const RunContext& run, const PlaneLimits& limits = {});

} // namespace pcl::floater
