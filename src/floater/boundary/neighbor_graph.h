// SPDX-License-Identifier: GPL-3.0-or-later
// A connected graph of near points, on which boundary points are ordered.
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Two near points.
struct NeighborEdge
{
  Index a, b;    ///< a < b
  Index rank;    ///< 0 if one is the nearest point of the other, 1 if the second nearest, and so on
  double length; ///< distance
};

/// The k nearest neighbours of every point, made symmetric and connected: a gap that no
/// neighbourhood spans is bridged where it is narrowest, by an edge of rank k. Each pair once, with
/// its smaller rank, ascending in (a, b). O(n (k + log n)), and O(n log^2 n) at most where there
/// are gaps.
std::vector<NeighborEdge>
neighborGraph (const std::vector<Eigen::Vector3d>& points, Index k);

/// The edges of rank below k of a connected graph of `size` points, and the shortest others that
/// keep it connected.
std::vector<NeighborEdge>
nearestPart (const std::vector<NeighborEdge>& graph, std::size_t size, Index k);

} // namespace floater
} // namespace pcl
