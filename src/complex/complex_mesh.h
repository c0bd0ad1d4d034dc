// SPDX-License-Identifier: GPL-3.0-or-later
// From stars to a manifold with rims: what both methods take from the complex.
#pragma once

#include "complex/candidate_triangles.h"
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

/// Complex, manifold part, and once more where there is room left. O(n + m log m) for m doubtful
/// candidates.
/// \param candidates see buildComplex; consumed
/// \param crease normals by which candidates were judged; consumed
/// \param normals in and out: those of the stars get consistent signs
ComplexMesh
makeComplexMesh (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
                 std::vector<CandidateLists> candidates, std::vector<Eigen::Vector3f> crease,
                 int threads, std::vector<Eigen::Vector3f>& normals);

/// The same from stars of all points. On sharp edges triangles are judged by the mean normal, from
/// which both faces are seen.
ComplexMesh
makeComplexMesh (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
                 const Stars& stars, const std::vector<float>& spacing, int threads,
                 std::vector<Eigen::Vector3f>& normals);

/// Vertices of each piece of a mesh.
std::vector<std::size_t>
pointsOfPieces (const SurfaceMesh& mesh, const std::vector<Index>& piece_of, Index count);

} // namespace floater
} // namespace pcl
