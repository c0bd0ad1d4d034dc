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
/// with fewer corners. OWN_SHAPE has the corners of the loop's own convex hull (see own_shape.h). A
/// loop without such a shape, because it lies on a line or winds around itself, is laid on the
/// circle.
///
/// The result is strictly convex, in floating point too, for loops of up to a million points. For
/// this, the sides of polygons bulge with a thousandth of the circle's curvature (by 2.5e-4 in the
/// middle of a square's side), and steps are widened to 4e-6, or to half of the mean step of their
/// side if that is less. On a straight side, an interior point whose neighbours are all on it would
/// fall on it. O(loop), OWN_SHAPE O(loop log loop).
/// \param positions per point
/// \param loop      points in order, at least 3
/// \return parameters, parallel to the loop
std::vector<Eigen::Vector2d>
layLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
         const DomainOptions& options);

// Connection of the points with the boundary loop, which the linear system needs: for unconnected
// unknowns, UMFPACK may return OK and put them all on the origin.

/// Points with a path to the loop along directed neighbours.
struct Reachability
{
  std::vector<std::uint8_t> reachable; ///< per point; 1 for points of the loop
  /// (point, neighbour): links to add so that `reachable` holds; ascending.
  std::vector<std::array<Index, 2>> links;
  std::size_t linked_points = 0; ///< distinct points in links
};

/// A reverse breadth-first search from the loop over `neighbors`. Then, in rounds until nothing
/// changes: every unreached point with reached ones among its nearest neighbours, or that is among
/// theirs, is linked to the nearest of them (DiscLimits::links_per_point), and the search continues
/// from it. All points at the edge of an unconnected set are linked in one round: with a single
/// link, it would shrink to a point. The rest belongs to another component. O(entries).
/// \param neighbors rows of the linear system
/// \param nearest   nearest neighbours of each point, not filtered
/// \param positions per point
/// \param loop      points of the loop
Reachability
reachLoop (const CsrLists& neighbors, const CsrLists& nearest,
           const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
           const RunContext& run, const DiscLimits& limits = {});

} // namespace pcl::floater
