// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points so far away that they would spoil the frame of all others.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// When a point is a gross outlier. Distances are the largest difference in a coordinate, from the
/// median of all points in each coordinate. The bulk is what lies around it: half of the points and
/// more, up to the first wide gap. The values are chosen: real surfaces come nowhere near them.
struct GrossOutlierLimits
{
  double gap = 1000.0;     ///< ratio of two consecutive distances from which on there is a wide gap
  double near = 1.0 / 32;  ///< points within this part of their distance may be one object
  std::size_t object = 8;  ///< distinct points from which on they are one
  std::size_t fewest = 21; ///< of a cloud; in smaller ones, there is no telling
  double steps = 8192.0;   ///< of double precision in a spacing of the bulk, that have to be left
};

/// Points beyond the bulk; both lists are rows, ascending, and have no row in common.
struct GrossOutliers
{
  std::vector<Index> isolated;   ///< beyond a wide gap, and no object of their own
  std::vector<Index> unbearable; ///< so far away that with them in the frame, double precision no
                                 ///< longer tells the points of the bulk apart
};

/// Finds gross outliers: coordinates such as 1e10 or FLT_MAX, and (0, 0, 0) far from a surface in
/// map coordinates. Each copy of equal points is listed. Objects far apart, and parts with points
/// all the way to the bulk, are none. Non-finite points are ignored. The result does not depend on
/// the order of the points. O(n), 60 nanoseconds and 8 bytes per point; a search for neighbours
/// among the points beyond a gap, if there is one.
GrossOutliers
findGrossOutliers (const std::vector<Eigen::Vector3d>& positions, const RunContext& run,
                   const GrossOutlierLimits& limits = {});

} // namespace pcl::floater
