// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Repair of folds, which flips alone cannot remove: vertices in the wrong triangles are moved.
#pragma once

#include "mesh/vertex_repair.h"

#include <vector>

namespace pcl::floater {
/// Edges whose two triangles are more than 120 degrees apart (isFold), each once. O(n).
std::vector<MeshEdge>
findFolds (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           const RunContext& run);

/// Moves vertices that are in the wrong triangles, as where the parameterization mixed up their
/// order or where they were connected to another sheet. No single flip lowers the cost there.
/// Vertices are taken out and put back elsewhere (see VertexMover), in two steps:
///
/// Moves: the corners of bad triangles are moved to where they cost least (see RepairTarget for
/// which of them). Each further pass looks at the old and new neighbours of the vertices that were
/// moved.
///
/// Kicks: a vertex at a fold that is left is moved to a place where the cost is higher, and the
/// vertices around it are moved after it. This is kept if the cost of the mesh is lower in the end,
/// and otherwise undone; then the place of the next higher cost is tried. Kicks remove folds that
/// stand alone. Where sheets are closer to each other than their points, hundreds of folds are left
/// and nearly all kicks fail. So the number of kicks is limited by the size of the mesh, and each
/// vertex gets an equal share of them. A vertex that was kicked to all its places in vain is kicked
/// again only after a triangle around it has changed.
///
/// Every step that is kept lowers the cost of the mesh. The boundary stays. O(n) at worst, O(bad
/// vertices) where few are bad. Blocks of a whole mesh are repaired first, on all threads, then
/// what is left between them. Of a part of a mesh, fixed triangles stay; it takes one thread.
/// \param neighbors nearest neighbours of each point, where places for it are searched
/// \param scatter   points around which the cloud is flat at no scale, ascending
/// \return number of moves and kicks that were kept
std::size_t
moveVertices (TriangleMesh& mesh, const CsrLists& neighbors, const std::vector<Index>& scatter,
              const TriangleCost& cost, const std::vector<Eigen::Vector3d>& positions,
              const RepairLimits& limits, const RunContext& run);

} // namespace pcl::floater
