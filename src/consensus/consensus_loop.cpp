// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus_loop.h"

#include "consensus/consensus_mesh.h"
#include "floater/boundary/gaps.h"
#include "floater/boundary/loop_refinement.h"
#include "mesh/open_loops.h"

#include <algorithm>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double LARGE_TRIANGLE = 2.0; // circumradius in spacings: beside it there is a gap
} // namespace

Boundary
consensusLoop (const std::vector<Eigen::Vector3d>& positions, const LocalGeometry& geometry,
               const RunContext& run)
{
  const ConsensusMesh consensus =
      makeConsensusMesh (positions, geometry.neighbors, geometry.stars, geometry.spacing, run);
  const MeshComponents components = findComponents (consensus.mesh);
  const std::vector<std::size_t> component_points = countPoints (consensus.mesh, components);
  std::vector<BoundaryLoop> loops =
      findBoundaryLoops (consensus.mesh, components, positions, geometry.spacing);
  const BoundaryLimits limits;
  const std::vector<LoopEvidence> evidence =
      findEvidence (loops, positions, geometry.neighbors, consensus.normals, limits, run);
  HoleOptions keep_largest;
  keep_largest.policy = HolePolicy::KEEP_LARGEST;
  chooseOpenLoops (loops, evidence, component_points, keep_largest, 1.0, limits);

  // Ragged borders have points beyond the triangles: the ends of gaps tell them.
  std::vector<Index> candidates;
  for (const Gap& gap : findGaps (geometry.stars, geometry.spacing, LARGE_TRIANGLE))
    candidates.push_back (gap.point);
  Boundary boundary;
  const auto largest = std::max_element (component_points.begin (), component_points.end ());
  for (BoundaryLoop& loop : loops) {
    candidates.insert (candidates.end (), loop.points.begin (), loop.points.end ());
    if (loop.keep_open &&
        loop.component == static_cast<Index> (largest - component_points.begin ()))
      boundary.loop = std::move (loop.points);
  }
  std::sort (candidates.begin (), candidates.end ());
  candidates.erase (std::unique (candidates.begin (), candidates.end ()), candidates.end ());
  boundary.candidates = candidates.size ();
  if (!boundary.loop.empty ())
    refineLoop (positions, geometry.stars, geometry.spacing, candidates, boundary.loop);
  return boundary;
}

} // namespace floater
} // namespace pcl
