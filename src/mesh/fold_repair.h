// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices that lie in the wrong triangles, which flips alone cannot mend.
#pragma once

#include "mesh/flips.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Edges whose two triangles are more than 120 degrees apart. O(n).
std::vector<MeshEdge>
findFolds (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           const RunContext& run);

/// Where points were laid out in the wrong order, or attached to the wrong sheet, no single flip
/// helps. Vertices are taken out and put back elsewhere (see VertexMover), in two steps:
///
/// Moves: all corners of triangles that are turned away from their normals, or more than 90 degrees
/// from a neighbour, are moved to where they cost least. The old and new neighbours of those that
/// have moved are looked at again, in at most 12 passes; few are left after five.
///
/// Kicks: a vertex at a fold that is left goes to a place that is worse, then the vertices around
/// move after it, twice; kept if the whole gains, else undone, and the place next in rank comes, up
/// to 16. These serve folds that stand alone. Where sheets are closer than the points on them,
/// hundreds of folds are left, and nearly all kicks are in vain. So there is one kick per 16 points
/// of the cloud and not more, dealt out evenly, cheapest places first; and who has been kicked to
/// all its places is only kicked again if a triangle at it has changed.
///
/// Every step kept lowers the cost of the mesh. The boundary stays. O(n) at worst, O(bad vertices)
/// where few are bad. One thread.
/// \return number of moves and kicks kept
std::size_t
moveVertices (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
              const std::vector<Eigen::Vector3d>& positions, const RunContext& run);

} // namespace floater
} // namespace pcl
