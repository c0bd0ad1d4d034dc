// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/complex_mesh.h"

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
                 std::vector<CandidateLists> candidates, std::vector<Eigen::Vector3f> crease,
                 int threads, std::vector<Eigen::Vector3f>& normals)
{
  SurfaceComplex complex = buildComplex (positions, candidates, crease);
  ComplexMesh made;
  made.mesh = manifoldPart (std::move (complex), near, threads);
  complex = {};
  const bool is_extended = extendComplex (positions, candidates, made.mesh, crease, complex);
  std::vector<CandidateLists> ().swap (candidates);
  if (is_extended) {
    made.misfits = std::move (complex.misfits);
    made.mesh = {};
    made.mesh = manifoldPart (std::move (complex), near, threads);
  }
  for (std::size_t p = 0; p < normals.size (); ++p)
    if (normals[p].dot (crease[p]) < 0.0F)
      normals[p] = -normals[p];
  return made;
}

ComplexMesh
makeComplexMesh (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
                 const Stars& stars, const std::vector<float>& spacing, int threads,
                 std::vector<Eigen::Vector3f>& normals)
{
  const Selection all = Selection::all (positions.size ());
  std::vector<Eigen::Vector3f> crease = creaseNormals (all, positions, near, normals, threads);
  std::vector<CandidateLists> candidates (1);
  candidates.front () = findCandidates (all, positions, stars, crease, spacing, {}, threads);
  return makeComplexMesh (positions, near, std::move (candidates), std::move (crease), threads,
                          normals);
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
