// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus_method.h"

#include "consensus/orientation_seam.h"
#include "mesh/insertion.h"

#include <utility>

namespace pcl::floater {
namespace {
ClosedHoles
closeHolesOf (TriangleMesh& mesh, const Points& points, const LocalGeometry& geometry,
              const SurfaceSettings& settings, const RunContext& run)
{
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  const MeshComponents components = findComponents (mesh, run);
  return closeHoles (mesh, findBoundaryLoops (mesh, components, positions, geometry.spacing, run),
                     components.count, positions, geometry.neighbors, geometry.stars.normals,
                     1.0 / points.scale, settings.holes, settings.limits.holeClosing (), run);
}

} // namespace

Surface
makeSurface (const Points& points, LocalGeometry& geometry, const SurfaceSettings& settings,
             const RunContext& run, std::optional<ProposedTriangles> proposed)
{
  const SurfaceLimits& limits = settings.limits;
  Surface surface;
  run.beginStage (Stage::CONSENSUS);
  ConsensusMesh consensus =
      proposed
          ? makeConsensusMesh (points.workingPositions (), geometry.neighbors,
                               std::move (geometry.stars.normals), std::move (*proposed),
                               limits.consensus, run)
          : makeConsensusMesh (points.workingPositions (), geometry.neighbors,
                               std::move (geometry.stars), geometry.spacing, limits.consensus, run);
  surface.mesh = std::move (consensus.mesh);
  surface.orientation_seam = findOrientationSeam (consensus.seam, limits.consensus.shortest_seam);
  geometry.stars = {};
  geometry.stars.normals = std::move (consensus.normals);

  run.beginStage (Stage::HOLES);
  ClosedHoles closed = closeHolesOf (surface.mesh, points, geometry, settings, run);
  surface.holes_filled = closed.filled;
  surface.doubtful_loops = std::move (closed.doubtful);
  orientMissingNormals (surface.mesh, geometry.neighbors, geometry.stars.normals, run);

  run.beginStage (Stage::FLIPS);
  surface.finish =
      finishMesh (surface.mesh, points.positions, geometry, settings.finishSettings (), run);
  return surface;
}

} // namespace pcl::floater
