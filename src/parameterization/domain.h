// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of the boundary loop (TW 385, section 2.1).
#pragma once

#include "common/types.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// Lays a closed loop on a convex curve, anti-clockwise, by chord length: arc length on the circle,
/// length along the sides of a polygon. The first loop point is at angle 0 of the circle, or at the
/// left end of the polygon's bottom side. Polygon corners get the loop point nearest to them by arc
/// length, each another one, so that no corner is cut off; a loop with fewer points than the
/// polygon has corners gets a polygon with as many corners as points.
///
/// The result is strictly convex also in floating point, for loops of up to a million points: sides
/// of polygons bulge by a thousandth of the circle's curvature (2.5e-4 in the middle of a square's
/// side), and steps shorter than 4e-6, or half of the mean step of their side if that is less, are
/// widened to it. Points of a straight side would not bind an interior point that hangs on them
/// alone: it would fall on the side. O(loop).
/// \param positions     per point
/// \param loop          points in order, at least 3
/// \param polygon_sides of Domain::POLYGON, at least 3
std::vector<Eigen::Vector2d>
layLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
         Domain domain, int polygon_sides);

} // namespace floater
} // namespace pcl
