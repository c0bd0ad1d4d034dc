// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of the boundary loop (TW 385, section 2.1).
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "core/types.h"
#include "floater/floater_method.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl::floater {
/// Lays a closed loop on a convex curve in the unit circle, anti-clockwise. Steps along the circle,
/// or along the sides of a polygon, are proportional to the lengths of the loop's steps, to the
/// square roots of these, or equal (LoopSpacing). The first point of the loop is at angle 0 of the
/// circle, or at the left end of the bottom side of a regular polygon.
///
/// Each corner of a regular polygon gets the loop point that is nearest along the loop, a different
/// one for each, so that no corner is cut off. A loop with fewer points than corners gets a polygon
/// with fewer corners.
///
/// The result is strictly convex, in floating point too, for loops of up to a million points. For
/// this, the sides of polygons bulge with a thousandth of the circle's curvature (by 2.5e-4 in the
/// middle of a square's side), and steps are widened to 4e-6, or to half of the mean step of their
/// side if that is less. On a straight side, an interior point whose neighbours are all on it would
/// fall on it. O(loop).
/// \return parameters, parallel to the loop
std::vector<Eigen::Vector2d>
layLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
         const DomainOptions& options);

} // namespace pcl::floater
