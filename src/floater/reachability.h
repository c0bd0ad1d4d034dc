// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which points are connected with the boundary loop, so that the linear system determines them. The
// solver does not tell: for unknowns that are not, UMFPACK may return OK and put them all on the
// origin.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "floater/disc_limits.h"

#include <vector>

namespace pcl::floater {
/// The points from which the loop can be reached along directed neighbours.
struct Reachability
{
  std::vector<std::uint8_t> reachable; ///< per point; 1 for points of the loop
  /// (point, neighbour): neighbours to add so that `reachable` holds; ascending.
  std::vector<std::array<Index, 2>> links;
  std::size_t linked_points = 0; ///< distinct points in links
};

/// A reverse breadth-first search from the loop over `neighbors`. Then, in rounds until nothing
/// more is reached: every point that has not been reached but has reached ones among its nearest
/// neighbours, or is among theirs, is linked to the nearest of them (DiscLimits::links_per_point),
/// and the search continues from it. All points at the edge of an unconnected part are linked in
/// one round, since a part with a single link would shrink to a point. What is still not reached is
/// another component. O(entries).
/// \param neighbors rows of the linear system: the neighbours in which each point is weighted
/// \param nearest   nearest neighbours of each point, not filtered
/// \param positions per point
/// \param loop      points of the loop
Reachability
reachLoop (const CsrLists& neighbors, const CsrLists& nearest,
           const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
           const RunContext& run, const DiscLimits& limits = {});

} // namespace pcl::floater
