// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary loop as the longest cycle that one edge closes in a spanning tree.
#pragma once

#include "local/stars.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// A loop and how far it can be trusted.
struct LongestLoop
{
  std::vector<Index> points;  ///< in order, each once; empty if there is none
  std::size_t candidates = 0; ///< points that look like boundary
  double largest_step = 0.0;  ///< longest edge of the loop, in local spacings
  double length = 0.0;        ///< of the loop, in the unit of the positions
};

/// Finds the longest boundary loop.
///
/// Candidates are points with a gap in their star (see gaps.h). They are joined by edges: cheapest
/// where each of the two sees the other at the end of its gap, dearer where only one does, dearest
/// between candidates that are merely near. A minimum spanning tree then runs along the borders,
/// and of all edges outside the tree the one that closes the longest cycle gives the loop; a spur
/// or a cluster of false candidates closes short cycles only. Candidates beside the loop are
/// inserted where the detour is small, and crossings are undone by 2-opt in a window. Done for
/// circumradius limits of 1.5, 2 and 2.5 spacings; the longest loop without a large step wins.
///
/// Weakness: two borders nearer to each other than about 3 spacings in more than one place may be
/// joined; a border whose steps exceed 6 spacings stays open. O(n + c log c) for c candidates.
LongestLoop
spanningTreeLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                  const std::vector<float>& spacing);

} // namespace floater
} // namespace pcl
