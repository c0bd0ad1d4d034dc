// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary loop as the longest cycle that one edge closes in a spanning tree.
#pragma once

#include "floater/boundary/boundary.h"

#include <vector>

namespace pcl::floater {
/// Finds the longest boundary loop. This method is not in TW 385.
///
/// Candidates are the points with a gap in their star (see gaps.h). An edge between them is
/// cheapest if each end is at the end of the other's gap, dearer if only one is, and dearest
/// between candidates that are only near each other. A minimum spanning tree then runs along the
/// borders. Of all other edges, the one that closes the longest cycle gives the loop; spurs and
/// clusters of false candidates close short cycles only. The loop is then refined (see
/// loop_refinement.h). The longest loop without a large step over all circumradius ratios of the
/// limits wins.
///
/// Weakness: two borders that come within about 3 spacings of each other in more than one place
/// may be joined, and a border stays open where its steps exceed LoopLimits::longest_edge.
/// O(n + c log c) for c candidates.
/// \param positions per point
/// \param stars     with their offsets
/// \param spacing   per point: local spacing, in the unit of the positions
/// \return loop, candidates and steps; the loop is empty if none was found. There is no problem.
Boundary
spanningTreeLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                  const std::vector<float>& spacing, const RunContext& run,
                  const LoopLimits& limits = {});

} // namespace pcl::floater
