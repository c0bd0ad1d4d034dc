// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/surface_method.h"

#include "complex/manifold_part.h"
#include "complex/rim_filling.h"
#include "neighborhoods/mean_normals.h"
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
std::vector<std::size_t>
pointsOfPieces (const SurfaceMesh& mesh, const std::vector<Index>& pieces, Index count)
{
  std::vector<std::size_t> points (count, 0);
  for (Index t : mesh.triangle_of)
    if (t != NONE)
      ++points[pieces[t]];
  return points;
}

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
makeSurface (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near, Stars& stars,
             double unit, const Options& options, StageClock& clock)
{
  Surface surface;
  clock.start (Stage::COMPLEX);
  const std::vector<float> spacing = localSpacing (positions, near, options.threads);
  {
    // On sharp edges triangles of both faces are to be seen.
    std::vector<Eigen::Vector3f> own = std::move (stars.normals);
    stars.normals = creaseNormals (positions, near, own, options.threads);
    const std::vector<Candidate> candidates =
        findCandidates (positions, stars, spacing, {}, options.threads);
    SurfaceComplex complex = buildComplex (positions, candidates, stars.normals);
    surface.misfits = complex.misfits;
    surface.mesh = manifoldPart (complex, near);
    complex = extendComplex (positions, candidates, surface.mesh, stars.normals);
    surface.mesh = manifoldPart (complex, near);
    for (std::size_t p = 0; p < own.size (); ++p)
      if (own[p].dot (stars.normals[p]) < 0.0F)
        own[p] = -own[p];
    stars.normals = std::move (own);
  }

  clock.start (Stage::HOLES);
  Index count = 0;
  const std::vector<Index> pieces = findPieces (surface.mesh, count);
  surface.rims = findRims (surface.mesh, pieces, positions, near, stars.normals, spacing);
  chooseRims (surface.rims, pointsOfPieces (surface.mesh, pieces, count), options, unit);
  const TriangleCost cost (positions, stars.normals);
  surface.holes_filled = fillRims (surface.mesh, surface.rims, positions, cost);
  orientMissingNormals (surface.mesh, near, stars.normals);

  clock.start (Stage::FLIPS);
  surface.finish = finishSurface (surface.mesh, positions, near, stars.normals, options);
  faceOutwards (surface.mesh, positions);
  surface.pieces = count;
  surface.is_one_disc = isDisc (surface.mesh, count);
  return surface;
}

} // namespace floater
} // namespace pcl
