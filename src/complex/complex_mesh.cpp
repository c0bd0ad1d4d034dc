// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/complex_mesh.h"

#include "complex/candidate_triangles.h"
#include "complex/manifold_part.h"
#include "complex/surface_complex.h"
#include "neighborhoods/mean_normals.h"

#include <utility>

namespace pcl
{
namespace floater
{
ComplexMesh
makeComplexMesh (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
                 const Stars& stars, const std::vector<float>& spacing, int threads,
                 std::vector<Eigen::Vector3f>& normals)
{
  std::vector<Eigen::Vector3f> crease = creaseNormals (positions, near, normals, threads);
  std::vector<Candidate> candidates =
      findCandidates (positions, stars, crease, spacing, {}, threads);
  SurfaceComplex complex = buildComplex (positions, candidates, crease);
  ComplexMesh made;
  made.mesh = manifoldPart (std::move (complex), near);
  complex = extendComplex (positions, candidates, made.mesh, crease);
  std::vector<Candidate> ().swap (candidates);
  made.misfits = std::move (complex.misfits);
  made.mesh = manifoldPart (std::move (complex), near);
  for (std::size_t p = 0; p < normals.size (); ++p)
    if (normals[p].dot (crease[p]) < 0.0F)
      normals[p] = -normals[p];
  return made;
}

std::vector<std::size_t>
pointsOfPieces (const SurfaceMesh& mesh, const std::vector<Index>& piece_of, Index count)
{
  std::vector<std::size_t> points (count, 0);
  for (Index t : mesh.triangle_of)
    if (t != NONE)
      ++points[piece_of[t]];
  return points;
}

} // namespace floater
} // namespace pcl
