// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points that stand for a missing measurement.
#pragma once

#include "core/types.h"

namespace pcl::floater {
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
findInvalidPoints (const Positions& positions, const Vector3d& shift);

} // namespace pcl::floater
