// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Changes a mesh so that its triangles do not cross each other.
#pragma once

#include "mesh/self_intersections.h"
#include "mesh/triangle_cost.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// What a change may cost, and how much is tried; the latter are limits of time. All were
/// chosen by hand.
struct UncrossingLimits
{
  double pair_cost = 1000.0;    ///< of a pair that crosses, in the unit of TriangleCost: as much as
                                ///< an edge that is folded by 180 degrees (CostLimits::fold_cost)
  std::size_t largest_fan = 24; ///< triangles around a vertex that is moved
  std::size_t places = 8;       ///< cheapest triangles in which a vertex to move is tried
  std::size_t passes = 6; ///< over the triangles that cross others; most is done in the first two

  /// Patches are rebuilt around a triangle: its corners and those of the triangles that it crosses,
  /// then the vertices beside, too. Over 25 pairs of sheets with a fifth of their points swapped,
  /// 480 pairs were left without this, 300 with one size of patch, 266 with two, as with three, and
  /// 266 with 2, 4 or 8 orders.
  std::size_t rebuilt_rings = 2;   ///< sizes of the patches
  std::size_t rebuilt_orders = 4;  ///< in which the vertices of a patch are put back
  std::size_t largest_patch = 200; ///< vertices; where more cross, a patch is no longer local
  std::size_t vain_rebuilds = 16;  ///< triangles around which patches are rebuilt in vain before
                                   ///< that is given up; four times as many gave the same
  std::size_t rebuilds_per_success = 8; ///< how many more for each that was not in vain

  /// Pairs of triangles with overlapping boxes that may be tested, for each triangle of the mesh
  /// and at least. Where points lie on no surface, each trial meets hundreds of triangles, and few
  /// trials help. A test takes about half a microsecond with all that belongs to it, so that a
  /// triangle may take 10 microseconds on average, and a small mesh a second.
  std::size_t tests_per_triangle = 20, fewest_tests = 2'000'000;
};

/// What was changed.
struct Uncrossing
{
  std::size_t flips = 0;      ///< edges flipped
  std::size_t moves = 0;      ///< vertices moved
  std::size_t rebuilds = 0;   ///< patches of vertices taken out and put back
  std::size_t pairs_left = 0; ///< pairs of triangles that still cross

  bool hasChanged () const { return flips + moves + rebuilds > 0; }
};

/// Flips edges and moves vertices (see VertexMover) where triangles cross; where neither helps any
/// more, all vertices of a patch are taken out and put back in other orders. A change is kept if no
/// more pairs cross after it, no more edges are folded (isFold), and it lowers the sum of the cost
/// of the mesh and that of the crossing pairs; of several, the one that lowers it most.
/// The boundary and the topology stay as they are, and so do fixed triangles; every point keeps its
/// triangles. O(n) to
/// begin with, and O(log n) for each of a few hundred trials for each triangle that crosses
/// another; the limits end it early. One thread.
/// \param pairs all that the mesh has (see findSelfIntersections)
/// \param neighbors nearest neighbours of each point, where places for it are searched
Uncrossing
removeSelfIntersections (TriangleMesh& mesh, const std::vector<CrossingPair>& pairs,
                         const CsrLists& neighbors, const TriangleCost& cost,
                         const std::vector<Eigen::Vector3d>& positions,
                         const UncrossingLimits& limits, const RunContext& run);

} // namespace pcl::floater
