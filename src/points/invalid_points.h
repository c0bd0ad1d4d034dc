// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points that stand for a missing measurement.
#pragma once

#include "core/types.h"

namespace pcl::floater {
/// Thresholds of invalid points. Chosen by hand, far from what real surfaces have.
struct InvalidPointLimits
{
  std::size_t fewest = 10; ///< points at one place that are pixels without a return
  double others = 5.0;     ///< they are more than this many times those at any other place
  double near = 0.01;      ///< all within this fraction of the range of the next point, and of most
  double apart = 3.0;      ///< range of the next point, in spacings of a flat sheet of that size
  double share = 5e-3;     ///< away from the origin: least share of the cloud
  double gap = 1.0;        ///< heights without data: gap to the others, in extents of these
  double zero_gap = 3.0;   ///< the same of the height 0, which may be a floor
  double zero_height = 100.0; ///< and the least height of the others then, in units of the cloud
};

/// Rows of points that are no measurements.
struct InvalidPoints
{
  std::vector<Index> pixels;          ///< at one place, where a sensor had no return
  std::vector<Index> cells;           ///< with one height, in a grid without data there
  Vector3d place = Vector3d::Zero (); ///< of the pixels
  double height = 0.0;                ///< of the cells
  double gap = 0.0;                   ///< from it to the nearest other height
};

/// Finds
/// - pixels without a return: many points at (0, 0, 0), or all nearer to it than the spacing, and
///   far nearer than the next one; or at any other place that nothing is near, as after a registration;
/// - cells without data in a grid of heights: z is a value such as -9999 or -32767, far below or
///   above all others; or 0 where the others are hundreds.
/// Non-finite points are ignored. O(n); O(n log n) where the lowest or highest z is one.
/// \param shift was subtracted from the positions
InvalidPoints
findInvalidPoints (const Positions& positions, const Vector3d& shift,
                   const InvalidPointLimits& limits = {});

} // namespace pcl::floater
