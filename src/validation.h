// SPDX-License-Identifier: GPL-3.0-or-later
// Checks before, between and after the stages.
#pragma once

#include "common/problem.h"
#include "common/types.h"
#include "triangulation/surface_mesh.h"

#include <pcl/surface/floater/options.h>

namespace pcl
{
namespace floater
{
/// Every option in its range, the solver there and fit for the ordering, the policy for holes and a
/// given loop fit for the topology.
Problem
checkOptions (const Options& options);

/// Enough points, not all on one line.
Problem
checkWorkingSet (const WorkingSet& set);

/// An oriented manifold disc whose boundary is the loop, each vertex with one fan. Reads the
/// triangles only, not the neighbours that the stages kept.
Problem
checkDisc (const std::vector<Triangle>& triangles, std::size_t points,
           const std::vector<Index>& loop);

} // namespace floater
} // namespace pcl
