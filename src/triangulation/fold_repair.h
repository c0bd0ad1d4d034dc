// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices that lie in the wrong triangles, which flips alone cannot mend.
#pragma once

#include "triangulation/flips.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Edges whose two triangles are more than 120 degrees apart. O(n).
std::vector<MeshEdge>
findFolds (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions);

/// Where points were laid out in the wrong order, or attached to the wrong sheet, no single flip
/// helps. Around every triangle that is turned away from its corners' normals, and every fold, one
/// vertex after the other is taken out, its hole filled by the triangulation of least cost, and the
/// vertex put back where that costs least among the triangles around its nearest neighbours, on
/// whatever sheet, with flips from there. A move is kept if it lowers the cost of the mesh, so this
/// ends; moved vertices' neighbours are looked at again. The boundary stays. O(bad vertices).
/// \return number of vertices moved
std::size_t
moveVertices (SurfaceMesh& mesh, const FlatLists& near, const TriangleCost& cost,
              const std::vector<Eigen::Vector3d>& positions);

} // namespace floater
} // namespace pcl
