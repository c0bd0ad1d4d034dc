// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus_loop.h"

#include "core/order_statistics.h"
#include "floater/boundary/gaps.h"
#include "floater/boundary/loop_refinement.h"

#include <algorithm>
#include <utility>

namespace pcl::floater {
Boundary
consensusLoop (const std::vector<Eigen::Vector3d>& positions, const LocalGeometry& geometry,
               const RunContext& run, const ConsensusLoopLimits& limits)
{
  const ConsensusMesh consensus = makeConsensusMesh (positions, geometry.neighbors, geometry.stars,
                                                     geometry.spacing, limits.consensus, run);
  const MeshComponents components = findComponents (consensus.mesh, run);
  const std::vector<std::size_t> component_points = countPoints (consensus.mesh, components);
  std::vector<BoundaryLoop> loops =
      findBoundaryLoops (consensus.mesh, components, positions, geometry.spacing, run);
  HoleOptions keep_largest;
  keep_largest.policy = HolePolicy::KEEP_LARGEST;
  chooseOpenLoops (loops,
                   judgeLoops (consensus.mesh, loops, positions, geometry.neighbors,
                               consensus.normals, limits.open_loops, run),
                   components.count, keep_largest, 1.0);

  // Beyond a ragged boundary there are points with gaps in their stars.
  std::vector<Index> candidates;
  for (const Gap& gap : findGaps (geometry.stars, geometry.spacing, limits.gap_ratio, run))
    candidates.push_back (gap.point);
  Boundary boundary;
  const auto largest = std::max_element (component_points.begin (), component_points.end ());
  for (BoundaryLoop& loop : loops) {
    candidates.insert (candidates.end (), loop.points.begin (), loop.points.end ());
    if (loop.keep_open &&
        loop.component == static_cast<Index> (largest - component_points.begin ()))
      boundary.loop = std::move (loop.points);
  }
  sortUnique (candidates);
  boundary.candidates = candidates.size ();
  if (!boundary.loop.empty ())
    refineLoop (positions, geometry.stars, geometry.spacing, candidates, boundary.loop, run);
  return boundary;
}

} // namespace pcl::floater
