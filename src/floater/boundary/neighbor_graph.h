// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A connected graph of neighbouring points, on which boundary points are ordered.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// An edge between two neighbouring points.
struct NeighborEdge
{
  Index a, b;    ///< a < b
  Index rank;    ///< 0 if one point is the nearest of the other, 1 if it is the second nearest, ...
  double length; ///< distance
};

/// The k nearest neighbours of every point as a symmetric, connected graph. Gaps that no
/// neighbourhood spans are bridged where they are narrowest, by edges of rank k. O(n (k + log n)),
/// where there are gaps O(n log^2 n) at most.
/// \return each pair once, with the smaller of its two ranks, ascending in (a, b)
std::vector<NeighborEdge>
neighborGraph (const std::vector<Eigen::Vector3d>& points, Index k, const RunContext& run);

/// The part of a connected graph in which edges have a rank below k, and the shortest others that
/// keep it connected. O(edges log edges).
/// \param size points of the graph
std::vector<NeighborEdge>
nearestPart (const std::vector<NeighborEdge>& graph, std::size_t size, Index k);

/// Clusters by region growing, each from the densest untaken point.
/// O(n log n) for n points along curves.
/// \param positions       per point
/// \param boundary_points ascending
/// \param tolerance       largest growing distance and radius in which density is counted, in the
///                        unit of the positions (xi D in TW 385)
/// \param k               nearest boundary points that are appended at a time
/// \return disjoint clusters of points, ascending in each; the largest cluster first, of equally
///         large ones that with the smallest point
std::vector<std::vector<Index>>
clusterBoundaryPoints (const std::vector<Eigen::Vector3d>& positions,
                       const std::vector<Index>& boundary_points, double tolerance, int k,
                       const RunContext& run);

} // namespace pcl::floater
