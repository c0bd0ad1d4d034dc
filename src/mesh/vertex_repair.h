// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Moves and kicks of vertices in the wrong triangles.
#pragma once

#include "mesh/triangle_cost.h"
#include "mesh/vertex_mover.h"

#include <vector>

namespace pcl::floater {
/// Limits of the search, to limit its time: larger values may remove a few more folds. Chosen by
/// hand; no measurement is recorded.
struct RepairLimits
{
  std::size_t largest_fan = 16;   ///< triangles around a vertex that is moved
  std::size_t patch_points = 512; ///< points along the space-filling curve in the patch around a
                                  ///< vertex; larger than usual defects
  int passes = 12;                ///< over the vertices to move; few are left after five
  std::size_t places = 4;         ///< cheapest triangles in which a vertex to move is tried
  std::size_t kicks = 16;         ///< triangles to which a vertex of a fold is kicked; at most 255
  std::size_t points_per_kick = 16;  ///< points of the mesh for each kick
  int passes_after_kick = 2;         ///< moves of the vertices around
  std::size_t places_after_kick = 3; ///< `places` in these moves

  /// Maximum number of requested costs (CachedCost::asked), per point of the mesh and minimum: by
  /// moves, and by kicks. Each takes some 40 nanoseconds in total, and all else
  /// for an ordinary point 10 microseconds, so a mesh takes at most six times as long with the
  /// repair. Laser scans of trees and rooms request up to 560 and 930, points in nearly coinciding
  /// pairs 3000 and 860 without a limit.
  std::size_t costs_of_moves = 600, costs_of_kicks = 1000, fewest_costs = 5'000'000;
};

/// Repairs a mesh or a block of one (see moveVertices). One thread.
class VertexRepair
{
public:
  /// All arguments must outlive the object.
  /// \param neighbors nearest neighbours of each point, candidates for a vertex's new neighbours
  /// \param targets   of each point
  VertexRepair (TriangleMesh& mesh, const CsrLists& neighbors,
                const std::vector<RepairTarget>& targets, const TriangleCost& cost,
                const RepairLimits& limits, const RunContext& run)
      : mesh_ (mesh), limits_ (limits), run_ (run),
        mover_ (mesh, neighbors, cost, limits.largest_fan, run), targets_ (targets)
  {
  }

  /// Moves these vertices, if they are bad, and those around them.
  /// \param most_costs number of requested costs at which moves end
  /// \return number of moves
  std::size_t moveAll (std::vector<Index> vertices, std::size_t most_costs);

  /// Kicks the vertices at folds among these, within the limits.
  /// \return number of kicks that were kept
  std::size_t kickAll (std::vector<Index> vertices);

  /// Number of requested costs.
  std::size_t costs () const { return cost_.asked (); }

private:
  bool isBadTriangle (Index t);
  void keepThoseToMove (std::vector<Index>& vertices);
  bool isToMove (Index v);
  bool isAtFold (Index v);
  bool kick (Index v, std::size_t times);
  double moveAfterKick (double change_by_kick);
  bool noteRing (Index v);
  void allowKicksAround (std::vector<Index>& again);
  bool isSpent () const { return costs () >= most_costs_; }

  TriangleMesh& mesh_;
  const RepairLimits& limits_;
  RunContext run_;
  VertexMover mover_;
  CachedCost& cost_ = mover_.cost ();
  const std::vector<RepairTarget>& targets_;
  std::vector<std::uint8_t> next_rank_; // per point: rank of its next kick
  std::size_t kicks_left_ = 0;
  std::size_t most_costs_ = 0;            // limit for kicks
  std::vector<std::vector<Index>> rings_; // neighbours at the triangles tried so far
  std::vector<Index> fan_, around_, changed_;
};

} // namespace pcl::floater
