// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Repair of folds that flips cannot remove: vertices in the wrong triangles are moved.
#pragma once

#include "core/order_statistics.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_cost.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Adds one ring of vertices to a patch, and sorts it.
inline void
addRing (const TriangleMesh& mesh, std::vector<Index>& patch)
{
  std::vector<Index> wider, fan;
  for (const Index v : patch) {
    mesh.fan (v, fan);
    for (const Index t : fan)
      wider.insert (wider.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
  }
  sortUnique (wider);
  patch.swap (wider);
}

/// Limits of the search, to limit its time: larger values may remove a few more folds. Chosen by
/// hand. With fans of 16, moves at sharp edges left triangles that cross.
struct RepairLimits
{
  std::size_t largest_fan = 12; ///< triangles around a vertex that is moved
  int passes = 12;              ///< over the vertices to move; few are left after five
  std::size_t places = 4;       ///< cheapest triangles in which a vertex to move is tried
  std::size_t kicks = 16;       ///< triangles to which a vertex of a fold is kicked; at most 255
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

/// Edges whose two triangles are more than 120 degrees apart (isFold), each once. O(n).
std::vector<MeshEdge>
findFolds (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           const RunContext& run);

/// Flips folded edges, and edges beside them, as long as each flip leaves fewer folds and no
/// crossing pair more, and its triangles have no edge of more than 3 spacings. O(n) for the table of crossing pairs.
/// \param crossing all pairs of the mesh
/// \return number of flips
std::size_t
flipFolds (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           const std::vector<float>& spacing, const std::vector<CrossingPair>& crossing,
           const RunContext& run);

/// Moves vertices that are in the wrong triangles, for example where the parameterization mixed up
/// their order or where they were connected to another sheet. No single flip lowers the cost there.
/// Vertices are removed and reinserted (see VertexMover), in two steps:
///
/// Moves: the corners of bad triangles (see isBad) are moved to where they cost least. Each
/// further pass processes the old and new neighbours of the moved vertices.
///
/// Kicks: a vertex at a remaining fold is moved to a triangle of higher cost, and then the vertices
/// around it are moved. If the mesh costs less in the end, this is kept; otherwise it is undone,
/// and the triangle of the next higher cost is tried. Kicks remove isolated folds. Where sheets are
/// closer to each other than their points, hundreds of folds remain and nearly all kicks fail. So
/// the number of kicks is limited by the size of the mesh, and shared equally by the vertices. A
/// vertex whose kicks all failed is kicked again only after a triangle around it has changed.
///
/// Every kept step lowers the cost of the mesh. The boundary stays. O(n) at worst, O(bad vertices)
/// if few are bad.
/// \param neighbors nearest neighbours of each point, candidates for a vertex's new neighbours
/// \return number of moves and kicks that were kept
std::size_t
moveVertices (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
              const std::vector<Eigen::Vector3d>& positions, const RepairLimits& limits,
              const RunContext& run);

} // namespace pcl::floater
