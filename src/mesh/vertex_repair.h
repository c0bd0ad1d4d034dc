// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Moves and kicks of vertices that are in the wrong triangles.
#pragma once

#include "mesh/repair_targets.h"
#include "mesh/vertex_mover.h"

#include <vector>

namespace pcl::floater {
/// How much is tried to remove folds. All are limits of time: larger values may remove a few more
/// folds. They were chosen by hand; no measurement is recorded.
struct RepairLimits
{
  std::size_t largest_fan = 16;   ///< triangles around a vertex that is moved
  std::size_t patch_points = 512; ///< along the space-filling curve, the patch around a vertex. It
                                  ///< is to be larger than what is wrong in a surface
  int passes = 12;                ///< over the vertices to move; few are left after five
  std::size_t places = 4;         ///< cheapest triangles in which a vertex to move is tried
  std::size_t kicks = 16;         ///< places to which a vertex of a fold is kicked; at most 255
  std::size_t points_per_kick = 16;  ///< points of the mesh for each kick
  int passes_after_kick = 2;         ///< moves of the vertices around
  std::size_t places_after_kick = 3; ///< the same as `places`, in these moves

  std::size_t rebuilt_rings = 2;  ///< sizes of the patches that are taken out and put back
  std::size_t rebuilt_orders = 4; ///< in which their vertices are put back
  std::size_t vain_rebuilds = 16; ///< vertices at folds around which that is tried in vain before
                                  ///< it is given up
  std::size_t rebuilds_per_success = 8; ///< how many more for each that was not in vain

  /// Costs of triangles that may be asked for (CachedCost::asked), for each point of the mesh and
  /// at least: by moves, and by kicks and rebuilt patches. Each takes some 40 nanoseconds with all
  /// that belongs to it, and all else for an ordinary point 10 microseconds, so that the repair
  /// takes at most six times as long as a mesh without it. Laser scans of trees and rooms ask for
  /// up to 560 and 930, points in pairs that nearly coincide for 3000 and 860 without a limit.
  std::size_t costs_of_moves = 600, costs_of_kicks = 1000, fewest_costs = 5'000'000;
};

/// Changes a mesh, or a block of one, where it is bad (see moveVertices for what is done, and why).
/// One thread.
class VertexRepair
{
public:
  /// All arguments must outlive the object.
  /// \param neighbors nearest neighbours of each point, where places for it are searched
  /// \param targets   of each point
  VertexRepair (TriangleMesh& mesh, const CsrLists& neighbors,
                const std::vector<RepairTarget>& targets, const TriangleCost& cost,
                const RepairLimits& limits, const RunContext& run)
      : mesh_ (mesh), limits_ (limits), run_ (run),
        mover_ (mesh, neighbors, cost, limits.largest_fan, run), targets_ (targets)
  {
  }

  /// Moves these vertices, where they are bad, and those around them.
  /// \param most_costs that may be asked for; no vertex is moved any more when it is reached
  /// \return number of moves
  std::size_t moveAll (std::vector<Index> vertices, std::size_t most_costs);

  /// Kicks those of these vertices that are at folds, as often as the limits allow.
  /// \return number of kicks that were kept
  std::size_t kickAll (std::vector<Index> vertices);

  /// Takes patches around those of these vertices that are at folds out, and puts them back in an
  /// order for which the cost is lower, if there is one.
  /// \return number of patches that were changed
  std::size_t rebuildAll (const std::vector<Index>& vertices);

  /// How many costs were asked for so far.
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
  bool rebuildAround (Index v);
  bool isSpent () const { return costs () >= most_costs_; }

  TriangleMesh& mesh_;
  const RepairLimits& limits_;
  RunContext run_;
  VertexMover mover_;
  CachedCost& cost_ = mover_.cost ();
  const std::vector<RepairTarget>& targets_;
  std::vector<std::uint8_t> next_rank_; // per point: rank of the place to which it is kicked next
  std::size_t kicks_left_ = 0;
  std::size_t most_costs_ = 0;            // at which kicks and rebuilds end
  std::vector<std::vector<Index>> rings_; // neighbours at the places tried so far
  std::vector<Index> fan_, around_, changed_;
};

} // namespace pcl::floater
