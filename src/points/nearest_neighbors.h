// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The k nearest neighbours of points.
#pragma once

#include "core/csr_lists.h"
#include "points/caller_search.h"
#include "points/kd_tree.h"
#include "points/point_block.h"
#include "points/rows.h"

namespace pcl::floater {
/// The k nearest other points of some points, nearest first, ties by index; fewer if there are no
/// more. Row i of the result is that of rows[i]. Large clouds are cut into blocks with halos, each
/// with a kd-tree of its own; whether a halo is wide enough is checked, and the block cut anew if
/// it is not. So the result does not depend on the number of blocks. O(n log n).
/// \throws IndexLimitReached if there are 2^32 - 1 entries or more
CsrLists
findNearestNeighbors (const std::vector<Eigen::Vector3d>& positions, const Rows& rows, int k,
                      std::size_t blocks, const RunContext& run);

/// The same by a kd-tree of all positions.
CsrLists
findNearestNeighbors (const std::vector<Eigen::Vector3d>& positions, const Rows& rows, int k,
                      const KdTree& tree, const RunContext& run);

/// The same for points that a block owns; the block is widened where that is needed.
/// \param rows   points of the working set, ascending
/// \param points of the whole working set
CsrLists
findNearestOfBlock (BlockSearch& search, const Rows& rows, std::size_t points, int k,
                    const RunContext& run);

/// The same by the caller's search structure, in one thread. What it answers twice, or outside of
/// the working set, is ignored; it may answer fewer than k.
CsrLists
searchNearestNeighbors (CallerSearch& search, const Rows& rows, int k, const RunContext& run);

} // namespace pcl::floater
