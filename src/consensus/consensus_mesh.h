// SPDX-License-Identifier: GPL-3.0-or-later
// From the stars of the points to an oriented manifold.
#pragma once

#include "local/stars.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// The manifold that stars agree on, before its holes are filled.
struct ConsensusMesh
{
  TriangleMesh mesh;
  std::vector<Eigen::Vector3f> normals; ///< those of the stars, with the signs of the mesh
  std::vector<Triangle> seam; ///< triangles of three votes for which there is room, but which would
                              ///< contradict the orientation
};

/// Candidate triangles, the consensus among them, its manifold part, and all that once more where
/// there is room left. O(n + m log m) for m doubtful candidates.
/// \param positions by which the stars were made
/// \param neighbors nearest first
/// \param stars     of all points; freed as soon as the candidates are found
/// \param spacing   see localSpacing
ConsensusMesh
makeConsensusMesh (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                   Stars stars, const std::vector<float>& spacing, const RunContext& run);

} // namespace floater
} // namespace pcl
