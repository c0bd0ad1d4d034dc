// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points so far away that they would degrade the scale of all others.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// Thresholds of gross outliers. Distances are the largest coordinate difference from the median of
/// all points. The bulk is what surrounds it: at least half of the points, up to the first wide
/// gap. Chosen by hand; real surfaces stay far below.
struct GrossOutlierLimits
{
  double gap = 1000.0;     ///< ratio of consecutive distances that makes a wide gap
  double near = 1.0 / 32;  ///< points within this fraction of their distance may be one object
  std::size_t object = 8;  ///< smallest number of distinct points of an object
  std::size_t fewest = 21; ///< smallest cloud that is examined
  double steps = 8192.0;   ///< least number of double-precision steps in a spacing of the bulk
};

/// Rows of points beyond the bulk, ascending; the lists are disjoint.
struct GrossOutliers
{
  std::vector<Index> isolated;   ///< beyond a wide gap, and in no object
  std::vector<Index> unbearable; ///< too far away: with them, double precision would not resolve
                                 ///< the points of the bulk
};

/// Finds gross outliers: coordinates such as 1e10 or FLT_MAX, and (0, 0, 0) far from a surface in
/// map coordinates. All copies of equal points are listed. Far objects, and points connected to the
/// bulk, are kept. Non-finite points are ignored. The result does not depend on the order of the
/// points. O(n), 60 nanoseconds and 8 bytes per point; plus a neighbour search among the points
/// beyond a gap.
GrossOutliers
findGrossOutliers (const std::vector<Eigen::Vector3d>& positions, const RunContext& run,
                   const GrossOutlierLimits& limits = {});

} // namespace pcl::floater
