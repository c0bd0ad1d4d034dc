// SPDX-License-Identifier: GPL-3.0-or-later
// Which points the loop determines. No solver tells: UMFPACK returns OK for an island of points and
// puts it on the origin.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Links given to a point that does not reach the loop, at most. With one alone a lone point would
/// fall on the point that it is linked to.
constexpr std::size_t LINKS_PER_POINT = 3;

/// Points from which the loop can be reached along directed neighbours.
struct Reachability
{
  std::vector<std::uint8_t> reachable; ///< per point; 1 for points of the loop
  std::vector<std::array<Index, 2>>
      links;                     ///< (point, neighbour) to add so that `reachable` holds; ascending
  std::size_t linked_points = 0; ///< distinct points in links
};

/// Reverse breadth-first search from the loop over `neighbors`. Then, in rounds until nothing more
/// can be reached: every point not reached that is near reached ones (`near` read in both
/// directions) is linked to the LINKS_PER_POINT nearest of them, and the search goes on from it.
/// All of an island's rim is linked in one round, because an island with a single link would shrink
/// to a point. What stays unreachable is another component. O(entries). \param neighbors directed
/// rows of the system \param near      the unfiltered nearest neighbours
Reachability
reachLoop (const CsrLists& neighbors, const CsrLists& nearest,
           const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
           const RunContext& run);

} // namespace floater
} // namespace pcl
