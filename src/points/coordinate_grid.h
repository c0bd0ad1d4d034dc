// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Detection of coordinates that were rounded too much.
#pragma once

#include "points/points.h"

namespace pcl::floater {
/// Step to which coordinates along one axis seem to be rounded.
struct CoordinateGrid
{
  int axis = 0;
  double step = 0.0;                ///< in units of the cloud; 0: no grid, or fine enough
  double spacings = 0.0;            ///< the step in local spacings
  bool is_single_precision = false; ///< the step is the gap between 32-bit floats of this size
};

/// Finds coordinates that were rounded to a tenth of the local spacing or more, and the worst axis.
/// A grid alone is no evidence: a raster has one by design. It needs one of
/// - the step is the gap between 32-bit floats of this size, and no other axis whose floats are
///   finer has the same step;
/// - all three axes have the same step, and it is smaller than the spacing (up to 0.4 of it), or a
///   tenth of the points coincide.
///
/// Uses some 4096 points.
/// \param spacing local spacing of each point
CoordinateGrid
findCoordinateGrid (const Points& points, const std::vector<float>& spacing);

} // namespace pcl::floater
