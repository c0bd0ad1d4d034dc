// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/hole_closing.h"

#include <utility>

namespace pcl::floater {
ClosedHoles
closeHoles (TriangleMesh& mesh, std::vector<BoundaryLoop> loops, std::size_t components,
            const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Eigen::Vector3f>& normals, double unit, const HoleOptions& holes,
            const HoleClosingLimits& limits, const RunContext& run)
{
  const std::vector<LoopJudgement> judgements =
      judgeLoops (mesh, loops, positions, neighbors, normals, limits.open_loops, run);
  chooseOpenLoops (loops, judgements, components, holes, unit);
  const TriangleCost cost (positions, normals, nullptr, limits.cost);
  ClosedHoles closed;
  closed.filled = fillHoles (mesh, loops, positions, cost, limits.hole_filling, run);
  for (std::size_t i = 0; i < loops.size (); ++i)
    if (isDoubtful (judgements[i], limits.open_loops))
      closed.doubtful.push_back ({std::move (loops[i]), judgements[i]});
  return closed;
}

} // namespace pcl::floater
