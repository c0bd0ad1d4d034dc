// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus_method.h"

#include "consensus/consensus_mesh.h"
#include "consensus/orientation_seam.h"
#include "mesh/hole_filling.h"
#include "mesh/insertion.h"
#include "mesh/open_loops.h"

#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// Chooses the loops that stay open and fills the others. \return number of holes filled
std::size_t
closeHoles (TriangleMesh& mesh, const Points& points, const LocalGeometry& geometry,
            const HoleOptions& holes, const RunContext& run)
{
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  const std::vector<Eigen::Vector3f>& normals = geometry.stars.normals;
  const MeshComponents components = findComponents (mesh);
  std::vector<BoundaryLoop> loops =
      findBoundaryLoops (mesh, components, positions, geometry.spacing);
  const BoundaryLimits limits;
  const std::vector<LoopEvidence> evidence =
      findEvidence (loops, positions, geometry.neighbors, normals, limits, run);
  chooseOpenLoops (loops, evidence, countPoints (mesh, components), holes, 1.0 / points.scale,
                   limits);
  return fillHoles (mesh, loops, positions, TriangleCost (positions, normals), run);
}

} // namespace

Surface
makeSurface (const Points& points, LocalGeometry& geometry, const HoleOptions& holes,
             bool flip_edges, const RunContext& run)
{
  Surface surface;
  run.beginStage (Stage::CONSENSUS);
  ConsensusMesh consensus = makeConsensusMesh (points.workingPositions (), geometry.neighbors,
                                               std::move (geometry.stars), geometry.spacing, run);
  surface.mesh = std::move (consensus.mesh);
  surface.orientation_seam = findOrientationSeam (consensus.seam);
  geometry.stars = {};
  geometry.stars.normals = std::move (consensus.normals);

  run.beginStage (Stage::HOLES);
  surface.holes_filled = closeHoles (surface.mesh, points, geometry, holes, run);
  orientMissingNormals (surface.mesh, geometry.neighbors, geometry.stars.normals);

  run.beginStage (Stage::FLIPS);
  surface.finish = finishMesh (surface.mesh, points.positions, geometry, {flip_edges}, run);
  return surface;
}

} // namespace floater
} // namespace pcl
