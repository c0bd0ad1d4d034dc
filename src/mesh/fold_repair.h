// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Repair of folds that flips cannot remove: vertices in the wrong triangles are moved.
#pragma once

#include "core/order_statistics.h"
#include "mesh/triangle_mesh.h"
#include "mesh/vertex_repair.h"

#include <utility>
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

/// Edges whose two triangles are more than 120 degrees apart (isFold), each once. O(n).
std::vector<MeshEdge>
findFolds (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           const RunContext& run);

/// Moves vertices that are in the wrong triangles, for example where the parameterization mixed up
/// their order or where they were connected to another sheet. No single flip lowers the cost there.
/// Vertices are removed and reinserted (see VertexMover), in two steps:
///
/// Moves: the corners of bad triangles (see RepairTarget) are moved to where they cost least. Each
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
/// if few are bad. A whole mesh is repaired in blocks first, on all threads, then between them; a
/// submesh in one thread, without its fixed triangles.
/// \param neighbors nearest neighbours of each point, candidates for a vertex's new neighbours
/// \return number of moves and kicks that were kept
std::size_t
moveVertices (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
              const std::vector<Eigen::Vector3d>& positions, const RepairLimits& limits,
              const RunContext& run);

} // namespace pcl::floater
