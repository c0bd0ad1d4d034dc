// SPDX-License-Identifier: GPL-3.0-or-later
// Section 3 of TW 385: from stars to one ordered loop.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "local/local_geometry.h"
#include "points/points.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// The loop that the surface is hung in.
struct Boundary
{
  std::vector<Index> loop;    ///< points in order, each once; empty if there is a problem
  std::size_t candidates = 0; ///< points that look like boundary
  double largest_step = 0.0;  ///< longest edge of the loop, in local spacings ...
  Index longest_from = NONE;  ///< ... and the point where it begins
  Problem problem;            ///< NO_BOUNDARY or INVALID_LOOP
};

/// The user's loop if there is one, else by the method of the options, SPANNING_TREE or
/// TWO_SEGMENTS. Not yet checked.
Boundary
findBoundary (const Points& points, const LocalGeometry& geometry, const BoundaryOptions& options,
              const RunContext& run);

/// Sets the largest step of the loop. Makes it a problem, NO_BOUNDARY, if there is no loop, or one
/// that is a mere gap in the sampling. For loops that were found, not given.
void
checkBoundary (const Points& points, const std::vector<float>& spacing, bool is_given,
               Boundary& boundary);

} // namespace floater
} // namespace pcl
