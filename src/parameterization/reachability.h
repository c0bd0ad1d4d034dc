// SPDX-License-Identifier: GPL-3.0-or-later
// Which points the loop determines. No solver tells: UMFPACK returns OK for an island of points and
// puts it on the origin.
#pragma once

#include "common/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Points from which the loop can be reached along directed neighbours.
struct Reachability
{
  std::vector<std::uint8_t> reachable; ///< per point; 1 for points of the loop
  std::vector<std::array<Index, 2>> links; ///< (point, neighbour) to add so that `reachable` holds
};

/// Reverse breadth-first search from the loop over `neighbors`; then points not reached are linked
/// to a reached point, over `near` read in both directions, nearest first, and so on until nothing
/// more can be reached. What stays unreachable is another component. O(entries).
/// \param neighbors directed rows of the system
/// \param near      the unfiltered nearest neighbours
Reachability
reachLoop (const FlatLists& neighbors, const FlatLists& near, const std::vector<Eigen::Vector3d>& positions,
           const std::vector<Index>& loop);

} // namespace floater
} // namespace pcl
