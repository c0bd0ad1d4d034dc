// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Decides which boundary loops stay open, and fills the others.
#pragma once

#include "core/csr_lists.h"
#include "mesh/hole_filling.h"
#include "mesh/open_loops.h"

#include <vector>

namespace pcl::floater {
/// The limits of closeHoles.
struct HoleClosingLimits
{
  OpenLoopLimits open_loops;
  HoleFillingLimits hole_filling;
  CostLimits cost;
};

/// A boundary loop of the consensus mesh, and its judgement.
struct JudgedLoop
{
  BoundaryLoop loop;
  LoopJudgement judgement;
};

struct ClosedHoles
{
  std::size_t filled = 0;
  std::vector<JudgedLoop> doubtful; ///< in the order of their smallest points, see isDoubtful
};

/// Decides which loops stay open and fills the others. O(n) plus judgeLoops () and fillHoles ().
/// \param loops of the mesh, ascending by their smallest points
/// \param components number of components of the mesh
/// \param neighbors, normals of each point; read for points of loops and those around
/// \param unit length of one unit of the cloud in the unit of the positions
ClosedHoles
closeHoles (TriangleMesh& mesh, std::vector<BoundaryLoop> loops, std::size_t components,
            const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Eigen::Vector3f>& normals, double unit, const HoleOptions& holes,
            const HoleClosingLimits& limits, const RunContext& run);

} // namespace pcl::floater
