// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary stage (TW 385, section 3): from the geometry around each point to one ordered loop.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "floater/boundary/loop_limits.h"
#include "local/local_geometry.h"
#include "points/points.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl::floater {
/// The boundary loop of a disc.
struct Boundary
{
  std::vector<Index> loop;    ///< points in order, each once; empty if there is a problem
  std::size_t candidates = 0; ///< points that may lie on the boundary
  double largest_step = 0.0;  ///< longest edge of the loop, in local spacings
  Index longest_from = NONE;  ///< point where that edge begins
  Problem problem;            ///< NO_BOUNDARY or INVALID_LOOP
};

/// The loop in the options, or otherwise the one that their method finds (SPANNING_TREE or
/// TWO_SEGMENTS; for CONSENSUS see consensus_loop.h). May report INVALID_LOOP; for other problems
/// call checkBoundary ().
Boundary
findBoundary (const Points& points, const LocalGeometry& geometry, const BoundaryOptions& options,
              const RunContext& run, const LoopLimits& limits = {});

/// Measures the steps of the loop (see measureSteps ()). Reports NO_BOUNDARY for a loop of fewer
/// than 3 points, or a found one so short that it is a gap in the sampling. Does nothing after a
/// problem.
/// \param spacing  per point: local spacing
/// \param is_given the loop was given by the user
void
checkBoundary (const Points& points, const std::vector<float>& spacing, bool is_given,
               Boundary& boundary, const LoopLimits& limits = {});

/// Sets the largest step of the loop and the point where it begins. A step is measured in the mean
/// of the local spacings at its two ends. O(loop).
/// \param spacing per point: local spacing, in the unit of the positions
void
measureSteps (const std::vector<Eigen::Vector3d>& positions, const std::vector<float>& spacing,
              Boundary& boundary);

} // namespace pcl::floater
