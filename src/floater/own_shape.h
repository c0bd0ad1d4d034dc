// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The convex hull of a loop, as a domain.
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// A convex polygon whose corners are points of a loop.
struct OwnShape
{
  std::vector<std::size_t> corners;    ///< indices in the loop, ascending; empty: there is no shape
  std::vector<Eigen::Vector2d> places; ///< positions of the corners, anti-clockwise, in the unit
                                       ///< circle
};

/// Bounds that keep a loop on the sides of the polygon strictly convex in floating point.
struct SideLimits
{
  double curvature;     ///< of the bulging sides
  double shortest_step; ///< minimum along the sides
};

/// Projects the loop on its least-squares plane, seen anti-clockwise, and scales it into the unit
/// circle around the middle of its extent along its principal axes. The corners are the vertices of
/// the convex hull except for those in another order along the loop than along the hull (where the
/// projection crosses itself), those at which the hull turns too little for bulging sides, and
/// those too near to the next one for the points between them. There is no shape if fewer than
/// three are left. O(n log n).
/// \param positions per point
/// \param loop      points in order, at least 3
OwnShape
findOwnShape (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
              const SideLimits& limits);

/// True if a closed polygon turns left at every point and once around in total, in double
/// precision.
bool
isStrictlyConvex (const std::vector<Eigen::Vector2d>& polygon);

} // namespace pcl::floater
