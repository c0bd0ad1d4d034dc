// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of the boundary loop (TW 385, section 2.1).
#pragma once

#include "core/types.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// Lays a closed loop on a convex curve, anti-clockwise, by the spacing rule: steps along the
/// circle or the sides of a polygon are as the lengths of the loop's steps, as their square roots,
/// or equal. The first loop point is at angle 0 of the circle, or at the left end of the polygon's
/// bottom side. Regular polygon corners get the loop point nearest to them by these steps, each
/// another one, so that no corner is cut off; a loop with fewer points than the polygon has corners
/// gets a polygon with as many corners as points.
///
/// OWN_SHAPE has the corners of the loop's own convex hull, in its least-squares plane (see
/// own_shape.h), and what is between two corners on the side between them. A loop without such a
/// shape, on a line or turning around itself, is laid on the circle.
///
/// The result is strictly convex also in floating point, for loops of up to a million points: sides
/// of polygons bulge by a thousandth of the circle's curvature (2.5e-4 in the middle of a square's
/// side), and steps shorter than 4e-6, or half of the mean step of their side if that is less, are
/// widened to it. Points of a straight side would not bind an interior point that hangs on them
/// alone: it would fall on the side. O(loop).
/// \param positions     per point
/// \param loop          points in order, at least 3
std::vector<Eigen::Vector2d>
layLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
         const DomainOptions& options);

} // namespace floater
} // namespace pcl
