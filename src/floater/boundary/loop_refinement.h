// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Refinement of a boundary loop.
#pragma once

#include "core/run_context.h"
#include "floater/boundary/loop_limits.h"
#include "local/stars.h"

#include <vector>

namespace pcl::floater {
/// Undoes crossings by 2-opt in a window, and inserts candidates that lie on or beyond an edge of
/// the loop where the detour is small. Otherwise such a point would be an interior point outside of
/// the boundary, and the surface would fold there. O(points + c log n) for c candidates and a loop
/// of n points.
/// \param positions  per point
/// \param stars      with normals, which give the side of the surface
/// \param spacing    per point: local spacing
/// \param candidates points that may lie on the boundary, on the loop or not
/// \param loop       at least 3 points in order
void
refineLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
            const std::vector<float>& spacing, const std::vector<Index>& candidates,
            std::vector<Index>& loop, const RunContext& run, const LoopLimits& limits = {});

} // namespace pcl::floater
