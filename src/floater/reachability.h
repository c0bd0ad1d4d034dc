// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Connection of the points with the boundary loop, which the linear system needs: for unconnected
// unknowns, UMFPACK may return OK and put them all on the origin.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "floater/disc_limits.h"

#include <vector>

namespace pcl::floater {
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
