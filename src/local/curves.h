// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that are curves, such as profiles of a scanner, too far apart for a surface.
#pragma once

#include "local/local_geometry.h"

namespace pcl::floater {
/// Limits of curves. Parallel lines on a wavy sheet, up to 30 times as far apart as their
/// points, have 0.91 or more of their points joined, 40 times 0.67, 60 times 0.42; single curves
/// 0.02 or less, profiles with corners 20 to 40 times as far apart up to 0.28.
struct CurveLimits
{
  double on_lines = 0.9;      ///< share of the points that lie on a line with their neighbours
  double even_step = 0.1;     ///< turns: of a step, how far it may be from the median; 7 % of the
                              ///< steps of strewn points are within it, 62 % of a golden spiral's
  double joined = 0.35;       ///< at most this share of them is joined to another curve
  std::size_t samples = 1000; ///< points looked at
  std::size_t least_points = 100; ///< fewer lie along lines by chance
};

struct Curves
{
  bool are_all = false; ///< the cloud is curves that are not joined
  double apart = 0.0; ///< median distance to points beside the curve, in steps along it; 0: unknown
};

/// Whether a cloud is curves: points on lines, or the turns of a sensor that turns about an axis
/// of the coordinates and moves along it, however noisy. A point is joined to another curve if a
/// triangle that its corners agree on has a corner beside its line, or in another turn.
/// \param origin of the cloud's coordinates
/// \param neighbors number of each point's neighbours that are nearest
Curves
findCurves (const Positions& positions, const Vector3d& origin, const LocalGeometry& geometry,
            std::size_t neighbors, double least_aspect, const ReachLimits& reach,
            const CurveLimits& limits, const RunContext& run);

} // namespace pcl::floater
