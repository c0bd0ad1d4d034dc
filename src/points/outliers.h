// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points of no surface: missing measurements, gross outliers of the whole cloud, and outliers of a
// neighbourhood.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
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
findGrossOutliers (const Positions& positions, const RunContext& run);

/// Outliers, ascending. The reach of a point is the distance to its 6th nearest neighbour, about 1.3
/// spacings. An outlier lies apart in one of two ways:
/// - it and at most 6 others are farther from all else than 5 times the reach of the points there;
/// - it lies off the plane of its neighbours by more than 1.75 times their reach, while they lie
///   well on that plane without it;
///
/// and too few points of the surface count it as close. This keeps sparse but connected points, as
/// beside a much denser region. Clouds of fewer than 21 points have no outliers. 0.2 microseconds
/// per point, in one thread where points lie apart.
/// \param neighbors of each point, nearest first
std::vector<Index>
findOutliers (const Positions& positions, const CsrLists& neighbors, const RunContext& run);

} // namespace pcl::floater
