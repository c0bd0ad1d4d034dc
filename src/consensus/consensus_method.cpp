// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus_method.h"

#include "consensus/orientation_seam.h"
#include "mesh/insertion.h"

#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// Chooses the loops that are kept open and fills the others. Notes how many were filled, and what
// the user should know of the decisions.
void
closeHoles (Surface& surface, const Points& points, const LocalGeometry& geometry,
            const SurfaceSettings& settings, const RunContext& run)
{
  const SurfaceLimits& limits = settings.limits;
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  const std::vector<Eigen::Vector3f>& normals = geometry.stars.normals;
  const MeshComponents components = findComponents (surface.mesh, run);
  std::vector<BoundaryLoop> loops =
      findBoundaryLoops (surface.mesh, components, positions, geometry.spacing, run);
  const std::vector<LoopJudgement> judgements = judgeLoops (
      surface.mesh, loops, positions, geometry.neighbors, normals, limits.open_loops, run);
  chooseOpenLoops (loops, judgements, components.count, settings.holes, 1.0 / points.scale);
  const TriangleCost cost (positions, normals, nullptr, limits.finish.cost);
  surface.holes_filled = fillHoles (surface.mesh, loops, positions, cost, limits.hole_filling, run);
  for (std::size_t i = 0; i < loops.size (); ++i)
    if (isDoubtful (judgements[i], limits.open_loops))
      surface.doubtful_loops.push_back ({std::move (loops[i]), judgements[i]});
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
  closeHoles (surface, points, geometry, settings, run);
  orientMissingNormals (surface.mesh, geometry.neighbors, geometry.stars.normals, run);

  run.beginStage (Stage::FLIPS);
  FinishSettings finish_settings;
  finish_settings.flip_edges = settings.flip_edges;
  finish_settings.open_boundary = true;
  finish_settings.facing = settings.facing;
  finish_settings.limits = limits.finish;
  surface.finish = finishMesh (surface.mesh, points.positions, geometry, finish_settings, run);
  return surface;
}

} // namespace floater
} // namespace pcl
