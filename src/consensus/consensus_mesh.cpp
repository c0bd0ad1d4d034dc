// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus_mesh.h"

#include "consensus/consensus.h"
#include "local/planes.h"

#include <utility>

namespace pcl::floater {
ClosedHoles
closeHoles (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            const LocalGeometry& geometry, double unit, const HoleOptions& holes,
            const HoleClosingLimits& limits, const RunContext& run)
{
  const std::vector<Eigen::Vector3f>& normals = geometry.stars.normals;
  const MeshComponents components = findComponents (mesh, run);
  std::vector<BoundaryLoop> loops =
      findBoundaryLoops (mesh, components, positions, geometry.spacing, run);
  const std::vector<LoopJudgement> judgements =
      holes.policy == HolePolicy::AUTO
          ? widenHoles (mesh, loops, positions, geometry.spacing, geometry.neighbors, normals,
                        limits.open_loops, limits.hole_widening, run)
          : judgeLoops (mesh, loops, positions, geometry.neighbors, normals, limits.open_loops,
                        run);
  chooseOpenLoops (loops, judgements, components.count, holes, unit);
  const TriangleCost cost (positions, normals, nullptr, limits.cost);
  ClosedHoles closed;
  closed.filled = fillHoles (mesh, loops, positions, cost, limits.hole_filling, run);
  for (std::size_t i = 0; i < loops.size (); ++i)
    if (isDoubtful (judgements[i], limits.open_loops))
      closed.doubtful.push_back ({std::move (loops[i]), judgements[i]});
  return closed;
}

ConsensusMesh
makeConsensusMesh (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                   Stars stars, const std::vector<float>& spacing, const ConsensusLimits& limits,
                   const RunContext& run)
{
  // Mean normals at sharp edges, where both faces are visible from them.
  std::vector<Eigen::Vector3f> smoothed =
      smoothedNormals (positions, neighbors, stars.normals, run);
  std::vector<Candidate> candidates =
      findCandidates (positions, stars, smoothed, spacing, limits.candidates, run);
  ConsensusMesh made;
  made.normals = std::move (stars.normals);
  stars = {};
  Consensus consensus = buildConsensus (positions, candidates, limits.candidates, smoothed, run);
  candidates = {};
  made.seam = std::move (consensus.seam);
  made.mesh = manifoldPart (std::move (consensus), neighbors, limits.smallest_island, run);
  for (std::size_t p = 0; p < made.normals.size (); ++p)
    if (made.normals[p].dot (smoothed[p]) < 0.0F)
      made.normals[p] = -made.normals[p];
  return made;
}

} // namespace pcl::floater
