// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/surface_method.h"

#include "complex/complex_mesh.h"
#include "complex/one_sided.h"
#include "complex/rim_filling.h"
#include "neighborhoods/stars.h"
#include "triangulation/flips.h"
#include "triangulation/insertion.h"
#include "triangulation/outward.h"

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
bool
isDisc (const SurfaceMesh& mesh, std::size_t pieces)
{
  std::size_t boundary_edges = 0;
  for (const auto& neighbors : mesh.neighbors)
    boundary_edges +=
        static_cast<std::size_t> (std::count (neighbors.begin (), neighbors.end (), NONE));
  const auto vertices = static_cast<std::int64_t> (
      mesh.triangle_of.size () - static_cast<std::size_t> (std::count (
                                     mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE)));
  const auto faces = static_cast<std::int64_t> (mesh.triangles.size ());
  const std::int64_t edges = (3 * faces + static_cast<std::int64_t> (boundary_edges)) / 2;
  return pieces == 1 && vertices - edges + faces == 1;
}

} // namespace

Surface
makeSurface (const std::vector<Eigen::Vector3d>& positions,
             const std::vector<Eigen::Vector3d>& final_positions, const FlatLists& near,
             Stars& stars, double unit, const Options& options, StageClock& clock)
{
  Surface surface;
  clock.start (Stage::COMPLEX);
  const std::vector<float> spacing = localSpacing (positions, near, options.threads);
  ComplexMesh complex =
      makeComplexMesh (positions, near, stars, spacing, options.threads, stars.normals);
  surface.mesh = std::move (complex.mesh);
  surface.cut = longestRow (complex.misfits);

  clock.start (Stage::HOLES);
  Index count = 0;
  const std::vector<Index> pieces = findPieces (surface.mesh, count);
  surface.rims = findRims (surface.mesh, pieces, positions, near, stars.normals, spacing);
  chooseRims (surface.rims, pointsOfPieces (surface.mesh, pieces, count), options, unit);
  const TriangleCost cost (positions, stars.normals);
  surface.holes_filled = fillRims (surface.mesh, surface.rims, positions, cost);
  orientMissingNormals (surface.mesh, near, stars.normals);

  clock.start (Stage::FLIPS);
  surface.finish = finishSurface (surface.mesh, final_positions, near, stars.normals, options);
  faceOutwards (surface.mesh, final_positions);
  surface.pieces = count;
  surface.is_one_disc = isDisc (surface.mesh, count);
  return surface;
}

} // namespace floater
} // namespace pcl
