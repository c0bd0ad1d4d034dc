// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Local search that removes folds and self-intersections from a mesh.
#pragma once

#include "mesh/folds.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_cost.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Costs and limits of the search. Where no measurement is told, they were chosen by hand.
struct RepairLimits
{
  /// Of a crossing pair: as much as an edge that is folded by 180 degrees.
  double pair_cost = TriangleCost::FOLD_COST;
  std::size_t passes = 6; ///< over the flawed triangles; the first two do most of the work

  /// Patches are rebuilt around a triangle: its corners and those of the triangles that it crosses,
  /// or else of those beside it, then also one ring around. Without this, three of four terrains
  /// with stacked points keep 6 to 19 crossing pairs, and 0 to 7 with it.
  std::size_t rebuilt_rings = 2;   ///< sizes of the patches
  std::size_t rebuilt_orders = 4;  ///< reinsertion orders of the vertices of a patch
  std::size_t largest_patch = 200; ///< vertices; with more crossings, a patch is no longer local
  std::size_t vain_rebuilds = 8; ///< failures to rebuild around a triangle before giving up; twice
                                 ///< as many, here and below, gave about the same
  std::size_t rebuilds_per_success = 4; ///< additional failures allowed for each success

  /// Pairs of triangles with overlapping boxes that may be tested: per triangle of the mesh, and
  /// minimum; at the end, three times as many. Where points lie on no surface, each trial meets hundreds
  /// of triangles, and few trials help. A test takes about a tenth of a microsecond in total, so a
  /// triangle may take three microseconds on average, and a small mesh a quarter of a second. Of three
  /// airborne scans, a third as many leave 2.1 times the pairs in 0.9 of the time; three times as many
  /// leave 0.9 of the pairs.
  std::size_t tests_per_triangle = 10, fewest_tests = 750'000;
};

/// What counts as a flaw besides triangles that cross, and what a change must not make worse.
enum class Repair
{
  BEFORE_REMAKING, ///< turned triangles (see TriangleCost), flat ones, and those more than 90 degrees
                   ///< from a neighbouring one; the sum of folded edges and crossing pairs
  AT_THE_END       ///< triangles at folded edges (isFold); the folded edges, and the crossing pairs
};

/// Changes made.
struct Repairs
{
  std::size_t flips = 0;    ///< edges flipped
  std::size_t moves = 0;    ///< vertices moved
  std::size_t rebuilds = 0; ///< patches of vertices removed and reinserted

  bool hasChanged () const { return flips + moves + rebuilds > 0; }

  Repairs& operator+= (const Repairs& more)
  {
    flips += more.flips;
    moves += more.moves;
    rebuilds += more.rebuilds;
    return *this;
  }
};

/// Flips edges and moves vertices (see VertexMover) at flawed triangles, where a vertex may be in
/// the wrong triangles, for example of another sheet; where neither helps, removes all vertices of
/// a patch and reinserts them in other orders. A change must lower the total cost of mesh and
/// crossing pairs, make no more long triangles (see TriangleCost), and not make worse what Repair
/// says; of several, the best is kept. The boundary and the topology stay; every point keeps its
/// triangles. O(n) initially, and O(log n) for each of a few hundred trials per flawed triangle,
/// within the limits; does nothing if some pairs are untested. One thread.
/// \param[in,out] crossing all pairs of the mesh (see findSelfIntersections)
/// \param neighbors nearest neighbours of each point, candidates for a vertex's new neighbours
/// \param ridges    edges that count neither as folded nor as bad
/// \param is_settled of each point: nothing is tried there unless something around changes; or empty
Repairs
repairFlaws (TriangleMesh& mesh, CrossingPairs& crossing, const CsrLists& neighbors,
             const TriangleCost& cost, const Positions& positions, Repair repair,
             const Ridges& ridges, const Flags& is_settled, const RepairLimits& limits,
             const RunContext& run);

} // namespace pcl::floater
