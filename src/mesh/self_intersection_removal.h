// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Removes self-intersections from a mesh.
#pragma once

#include "mesh/self_intersections.h"
#include "mesh/triangle_cost.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Costs, and limits of the search, to limit its time. All were chosen by hand.
struct UncrossingLimits
{
  double pair_cost = 1000.0;    ///< of a crossing pair, in the unit of TriangleCost: as much as an
                                ///< edge that is folded by 180 degrees (CostLimits::fold_cost)
  std::size_t largest_fan = 24; ///< triangles around a vertex that is moved
  std::size_t places = 8;       ///< cheapest triangles in which a vertex to move is tried
  std::size_t passes = 6;       ///< over the crossing triangles; the first two do most of the work

  /// Patches are rebuilt around a triangle: its corners and those of the triangles that it crosses,
  /// then also one ring around. Over 25 pairs of sheets with a fifth of their points swapped, 480
  /// pairs were left without this, 300 with one size of patch, 266 with two, as with three, and 266
  /// with 2, 4 or 8 orders.
  std::size_t rebuilt_rings = 2;   ///< sizes of the patches
  std::size_t rebuilt_orders = 4;  ///< reinsertion orders of the vertices of a patch
  std::size_t largest_patch = 200; ///< vertices; with more crossings, a patch is no longer local
  std::size_t vain_rebuilds = 16;  ///< failures to rebuild around a triangle before giving up; four
                                   ///< times as many gave the same
  std::size_t rebuilds_per_success = 8; ///< additional failures allowed for each success

  /// Pairs of triangles with overlapping boxes that may be tested: per triangle of the mesh, and
  /// minimum. Where points lie on no surface, each trial meets hundreds of triangles, and few
  /// trials help. A test takes about half a microsecond in total, so a triangle may take 10
  /// microseconds on average, and a small mesh a second.
  std::size_t tests_per_triangle = 20, fewest_tests = 2'000'000;
};

/// Changes made.
struct Uncrossing
{
  std::size_t flips = 0;      ///< edges flipped
  std::size_t moves = 0;      ///< vertices moved
  std::size_t rebuilds = 0;   ///< patches of vertices removed and reinserted
  std::size_t pairs_left = 0; ///< pairs of triangles that still cross

  bool hasChanged () const { return flips + moves + rebuilds > 0; }
};

/// Flips edges and moves vertices (see VertexMover) where triangles cross; where neither helps,
/// removes all vertices of a patch and reinserts them in other orders. A change must not increase
/// the number of crossing pairs or folded edges (isFold), and must lower the total cost of mesh and
/// crossing pairs; of several, the best is kept. The boundary, the topology
/// stay; every point keeps its triangles. O(n) initially, and O(log n) for each of a few hundred
/// trials per crossing triangle, within the limits. One thread.
/// \param pairs all pairs of the mesh (see findSelfIntersections)
/// \param neighbors nearest neighbours of each point, candidates for a vertex's new neighbours
Uncrossing
removeSelfIntersections (TriangleMesh& mesh, const std::vector<CrossingPair>& pairs,
                         const CsrLists& neighbors, const TriangleCost& cost,
                         const std::vector<Eigen::Vector3d>& positions,
                         const UncrossingLimits& limits, const RunContext& run);

} // namespace pcl::floater
