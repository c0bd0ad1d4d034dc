// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus_mesh.h"

#include "consensus/consensus.h"
#include "consensus/manifold_part.h"
#include "local/smoothed_normals.h"

#include <utility>

namespace pcl
{
namespace floater
{
ConsensusMesh
makeConsensusMesh (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                   Stars stars, const std::vector<float>& spacing, const ConsensusLimits& limits,
                   const RunContext& run)
{
  // Triangles are compared with smoothed normals: at a sharp edge, these see both faces.
  std::vector<Eigen::Vector3f> smoothed =
      smoothedNormals (positions, neighbors, stars.normals, run);
  CandidateLists candidates =
      findCandidates (positions, stars, smoothed, spacing, limits.candidates, run);
  ConsensusMesh made;
  made.normals = std::move (stars.normals);
  stars = {};

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

} // namespace floater
} // namespace pcl
