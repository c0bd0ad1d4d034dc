// SPDX-License-Identifier: GPL-3.0-or-later
// Folds that flips cannot undo.
#pragma once

#include "triangulation/surface_mesh.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Edges whose two triangles are more than 120 degrees apart. O(n).
std::vector<MeshEdge>
findFolds (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions);

/// Where the parameterization has laid a few points in the wrong order, no single flip helps.
/// Around each fold a patch of some rings is cut out; in it one vertex after the other is taken
/// out, its hole filled by the triangulation of least cost, and the vertex put back where its split
/// costs least, followed by flips. A change is kept if it lowers the cost of the patch, in which
/// folded edges count. The boundary stays. O(folds). \param normals oriented like the mesh (see
/// orientNormals) \param folds  as by findFolds () \return folds left
std::vector<MeshEdge>
repairFolds (SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const std::vector<Eigen::Vector3f>& normals, std::vector<MeshEdge> folds);

} // namespace floater
} // namespace pcl
