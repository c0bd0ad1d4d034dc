// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/surface_method.h"

#include "complex/complex_mesh.h"
#include "complex/one_sided.h"
#include "complex/rim_filling.h"
#include "triangulation/insertion.h"
#include "triangulation/outward.h"

#include <algorithm>
#include <utility>

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
makeSurface (Samples& samples, const Options& options, StageClock& clock)
{
  const std::vector<Eigen::Vector3d>& positions = samples.set.positions;
  const FlatLists& near = samples.near;
  std::vector<Eigen::Vector3f>& normals = samples.stars.normals;
  Surface surface;
  clock.start (Stage::COMPLEX);
  ComplexMesh complex = makeComplexMesh (positions, near, std::move (samples.candidates),
                                         std::move (samples.crease), options.threads, normals);
  surface.mesh = std::move (complex.mesh);
  surface.cut = longestRow (complex.misfits);

  clock.start (Stage::HOLES);
  Index count = 0;
  {
    const std::vector<Index> pieces = findPieces (surface.mesh, count);
    const std::vector<float> spacing = std::move (samples.spacing);
    surface.rims = findRims (surface.mesh, pieces, positions, near, normals, spacing);
    chooseRims (surface.rims, pointsOfPieces (surface.mesh, pieces, count), options,
                1.0 / samples.set.scale);
  }
  const TriangleCost cost (positions, normals);
  surface.holes_filled = fillRims (surface.mesh, surface.rims, positions, cost, options.threads);
  orientMissingNormals (surface.mesh, near, normals);

  clock.start (Stage::FLIPS);
  surface.finish = finishSurface (surface.mesh, samples.ownPositions (), near, normals, options);
  faceOutwards (surface.mesh, samples.ownPositions ());
  surface.pieces = count;
  surface.is_one_disc = isDisc (surface.mesh, count);
  return surface;
}

} // namespace floater
} // namespace pcl
