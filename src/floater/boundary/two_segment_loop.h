// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The order of a boundary cluster by two segments (TW 385, section 3.3).
#pragma once

#include "core/run_context.h"
#include "floater/boundary/boundary.h"
#include "local/stars.h"

#include <vector>

namespace pcl::floater {
/// Splits a cluster into two connected segments with common ends, orders each of them between its
/// ends by the univariate Floater parameterization (reciprocal distance weights), and joins them to
/// a loop. O(n log n).
///
/// The choices that TW 385 leaves open, or that differ here: the seed is the first point of the
/// cluster (TW 385: a random one); a segment first takes the point nearest to the seed along the
/// segment; neighbourhoods are symmetric; the parameterization uses the number of neighbours with
/// the shortest order (LoopLimits::univariate_k); gaps wider than any neighbourhood are bridged
/// where they are narrowest.
///
/// Weakness: where the cluster is a thick band, or the border turns back on itself within a
/// neighbourhood, the order is not that along the border.
/// \param positions per point
/// \param cluster   distinct points, in any order
/// \return every point of the cluster once, in order; empty if the cluster has fewer than 4 points,
///         if two of them coincide, or if the system of a segment is singular
std::vector<Index>
twoSegmentLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& cluster,
                const RunContext& run, const LoopLimits& limits = {});

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
