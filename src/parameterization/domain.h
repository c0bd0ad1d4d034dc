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
/// length along the sides of a polygon. Polygon corners get the loop point nearest to them, so that
/// no corner is cut off. Points on one side of a polygon are collinear: they are hull points, not
/// strictly convex ones.
/// \param loop          points in order, at least 3, consecutive ones distinct
/// \param polygon_sides of Domain::POLYGON
std::vector<Eigen::Vector2d>
layLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop, Domain domain,
         int polygon_sides);

} // namespace floater
} // namespace pcl
