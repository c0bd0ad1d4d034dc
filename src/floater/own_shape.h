// SPDX-License-Identifier: GPL-3.0-or-later
// The convex polygon that a loop brings along.
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Corners of a convex polygon among the points of a loop.
struct OwnShape
{
  std::vector<std::size_t> corners;    ///< places in the loop, ascending; empty: there is no shape
  std::vector<Eigen::Vector2d> places; ///< of the corners, anti-clockwise, in the unit circle
};

/// What a polygon must be fit for, so that a loop laid on it is strictly convex in floating point.
struct SideLimits
{
  double curvature;     ///< of the bulging sides
  double shortest_step; ///< that is aimed at along them
};

/// Projects the loop on its least-squares plane, seen from the side where it runs anti-clockwise,
/// and scales it into the unit circle about the middle of its extent along its principal axes. The
/// corners are the vertices of the convex hull, but for those that come in another order along the
/// loop than along the hull (a projection that crosses itself), that turn too little for sides that
/// bulge, or that are too near to the next for the points between them. Fewer than three: no shape.
/// O(n log n).
OwnShape
findOwnShape (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
              const SideLimits& limits);

/// True if a closed polygon turns left at every point, and once around in all, in double precision.
bool
isStrictlyConvex (const std::vector<Eigen::Vector2d>& polygon);

} // namespace floater
} // namespace pcl
