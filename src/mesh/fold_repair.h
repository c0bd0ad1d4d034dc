// SPDX-License-Identifier: GPL-3.0-or-later
// Repair of folds, which flips alone cannot remove: vertices in the wrong triangles are moved.
#pragma once

#include "mesh/flips.h"

#include <vector>

namespace pcl
{
namespace floater
{
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
};

/// Edges whose two triangles are more than 120 degrees apart (isFold), each once. O(n).
std::vector<MeshEdge>
findFolds (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
           const RunContext& run);

/// Moves vertices that are in the wrong triangles, as where the parameterization mixed up their
/// order or where they were connected to another sheet. No single flip lowers the cost there.
/// Vertices are taken out and put back elsewhere (see VertexMover), in two steps:
///
/// Moves: all corners of triangles that are turned away from their normals, or more than 90 degrees
/// from a neighbouring triangle, are moved to where they cost least. Where most points of a patch
/// are such corners, as in leaves or grass, there is no surface that tells where a vertex belongs:
/// only those at folds are moved there. Where most of them are scatter, nothing is moved, since no
/// place is better than another. Each further pass looks at the old and new neighbours of
/// the vertices that were moved.
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
/// vertices) where few are bad. One thread.
/// \param neighbors nearest neighbours of each point, where places for it are searched
/// \param scatter   points around which the cloud is flat at no scale, ascending
/// \return number of moves and kicks that were kept
std::size_t
moveVertices (TriangleMesh& mesh, const CsrLists& neighbors, const std::vector<Index>& scatter,
              const TriangleCost& cost, const std::vector<Eigen::Vector3d>& positions,
              const RepairLimits& limits, const RunContext& run);

} // namespace floater
} // namespace pcl
