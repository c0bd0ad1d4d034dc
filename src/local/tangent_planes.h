// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of the points by least-squares planes (TW 385, section 4.1).
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/rows.h"

#include <vector>

namespace pcl::floater {
/// What is taken for the sheet of a point. The first two values were chosen on the clouds of the
/// first benchmark, and are fragile: a fifth more or less of either costs 2 to 4 of 18 clean clouds
/// there (test/benchmark/flaws.py tells what changes with them).
struct PlaneLimits
{
  std::size_t core_points = 8; ///< nearest neighbours through which the first plane is laid: about
                               ///< the first ring of an even sampling, and a little more
  double sheet_sine = 0.5;     ///< of the largest angle, 30 degrees, between the first plane and a
                               ///< neighbour that the second one takes in
  double least_aspect = 0.05;  ///< of the points of the first plane (see Plane::aspect); neighbours
      ///< are added until it is reached. Points on a line with noise of one
      ///< step stay below, a third of an evenly sampled disc is above
};

/// Unit normals, of arbitrary sign: those of the planes through the 8 nearest neighbours, refitted
/// to those of all neighbours that lie near that plane. So a second sheet within reach does not
/// tilt them. Where the 8 nearest lie nearly on a line, as in scan lines, more are taken. O(n k).
/// \param neighbors of the points in `rows`, nearest first
/// \param rows      points whose normals are wanted; those of others are zero
std::vector<Eigen::Vector3f>
fitTangentPlanes (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  const Rows& rows, const RunContext& run, const PlaneLimits& limits = {});

} // namespace pcl::floater
