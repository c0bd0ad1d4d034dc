// SPDX-License-Identifier: GPL-3.0-or-later
// From stars to a manifold with rims: what both methods take from the complex.
#pragma once

#include "triangulation/surface_mesh.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// The manifold part of the complex, before its rims are filled.
struct ComplexMesh
{
  SurfaceMesh mesh;
  std::vector<Triangle> misfits; ///< triangles of three votes for which there is room, but which
                                 ///< would turn the orientation round
};

/// Candidates, complex, manifold part, and once more where there is room left. On sharp edges
/// triangles are judged by the mean normal, from which both faces are seen. O(n log n).
/// \param normals in and out: those of the stars get consistent signs; may be the stars' own
ComplexMesh
makeComplexMesh (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
                 const Stars& stars, const std::vector<float>& spacing, int threads,
                 std::vector<Eigen::Vector3f>& normals);

/// Vertices of each piece of a mesh.
std::vector<std::size_t>
pointsOfPieces (const SurfaceMesh& mesh, const std::vector<Index>& piece_of, Index count);

} // namespace floater
} // namespace pcl
