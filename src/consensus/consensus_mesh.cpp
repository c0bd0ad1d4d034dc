// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus_mesh.h"

#include "consensus/consensus.h"
#include "consensus/manifold_part.h"
#include "local/planes.h"

#include <utility>

namespace pcl::floater {
ClosedHoles
closeHoles (TriangleMesh& mesh, std::vector<BoundaryLoop> loops, std::size_t components,
            const std::vector<Eigen::Vector3d>& positions, const std::vector<float>& spacing,
            const CsrLists& neighbors, const std::vector<Eigen::Vector3f>& normals, double unit,
            const HoleOptions& holes, const HoleClosingLimits& limits, const RunContext& run)
{
  const std::vector<LoopJudgement> judgements =
      holes.policy == HolePolicy::AUTO
          ? widenHoles (mesh, loops, positions, spacing, neighbors, normals, limits.open_loops,
                        limits.hole_widening, run)
          : judgeLoops (mesh, loops, positions, neighbors, normals, limits.open_loops, run);
  chooseOpenLoops (loops, judgements, components, holes, unit);
  const TriangleCost cost (positions, normals, nullptr, limits.cost);
  ClosedHoles closed;
  closed.filled = fillHoles (mesh, loops, positions, cost, limits.hole_filling, run);
  for (std::size_t i = 0; i < loops.size (); ++i)
    if (isDoubtful (judgements[i], limits.open_loops))
      closed.doubtful.push_back ({std::move (loops[i]), judgements[i]});
  return closed;
}

ProposedTriangles
proposeTriangles (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  const Stars& stars, const std::vector<float>& spacing,
                  const CandidateLimits& limits, const RunContext& run)
{
  const Rows all = Rows::all (positions.size ());
  ProposedTriangles proposed;
  proposed.smoothed_normals = smoothedNormals (positions, neighbors, stars.normals, all, run);
  proposed.candidates =
      findCandidates (positions, stars, proposed.smoothed_normals, spacing, all, limits, run);
  return proposed;
}

ConsensusMesh
makeConsensusMesh (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                   Stars stars, const std::vector<float>& spacing, const ConsensusLimits& limits,
                   const RunContext& run)
{
  ProposedTriangles proposed =
      proposeTriangles (positions, neighbors, stars, spacing, limits.candidates, run);
  std::vector<Eigen::Vector3f> normals = std::move (stars.normals);
  stars = {};
  return makeConsensusMesh (positions, neighbors, std::move (normals), std::move (proposed), limits,
                            run);
}

ConsensusMesh
makeConsensusMesh (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                   std::vector<Eigen::Vector3f> normals, ProposedTriangles proposed,
                   const ConsensusLimits& limits, const RunContext& run)
{
  std::vector<Eigen::Vector3f> smoothed = std::move (proposed.smoothed_normals);
  CandidateLists candidates = std::move (proposed.candidates);
  ConsensusMesh made;
  made.normals = std::move (normals);
  Consensus consensus = buildConsensus (positions, candidates, smoothed, run);
  made.mesh = manifoldPart (std::move (consensus), neighbors, limits.smallest_island, run);
  consensus = {};
  const bool is_extended =
      extendConsensus (positions, candidates, made.mesh, smoothed, consensus, run);
  candidates = {};
  if (is_extended) {
    made.seam = std::move (consensus.seam);
    made.mesh = {};
    made.mesh = manifoldPart (std::move (consensus), neighbors, limits.smallest_island, run);
  }
  for (std::size_t p = 0; p < made.normals.size (); ++p)
    if (made.normals[p].dot (smoothed[p]) < 0.0F)
      made.normals[p] = -made.normals[p];
  return made;
}

} // namespace pcl::floater
