// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Balls whose radius follows the density (TW 385, section 6).
#pragma once

#include "core/csr_lists.h"
#include "points/caller_search.h"
#include "points/rows.h"

namespace pcl::floater {
/// Neighbours in the mean distance that is the local spacing; also the minimum in a ball.
constexpr int SPACING_NEIGHBORS = 6;
/// Maximum number of neighbours in a ball: beside a jump in density it may contain any number.
constexpr std::size_t MOST_IN_BALL = 200;

/// All other points in a ball around each point in `rows`, nearest first, ties by index. Row i
/// belongs to rows[i]. The radius is `radius` times the mean distance to the SPACING_NEIGHBORS
/// nearest. At least these, and at most the MOST_IN_BALL nearest. O(n (log n + neighbours)).
/// \throws IndexLimitReached if there are 2^32 - 1 entries or more
CsrLists
findBallNeighbors (const std::vector<Eigen::Vector3d>& positions, const Rows& rows, double radius,
                   const RunContext& run);

/// findBallNeighbors () by the caller's search structure, in one thread.
CsrLists
searchBallNeighbors (CallerSearch& search, const Rows& rows, double radius, const RunContext& run);

} // namespace pcl::floater
