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
/// The k nearest other points of the points in `rows`, nearest first, ties by index; fewer if there
/// are no more. Row i belongs to rows[i]. Large clouds are cut into blocks with halos, each with a
/// kd-tree of its own. A block whose halo is too narrow is cut again, so the result does not depend
/// on the number of blocks. O(n log n).
/// \throws IndexLimitReached if there are 2^32 - 1 entries or more
CsrLists
findNearestNeighbors (const std::vector<Eigen::Vector3d>& positions, const Rows& rows, int k,
                      std::size_t blocks, const RunContext& run);

/// findNearestNeighbors () with a kd-tree of all positions.
CsrLists
findNearestNeighbors (const std::vector<Eigen::Vector3d>& positions, const Rows& rows, int k,
                      const KdTree& tree, const RunContext& run);

/// findNearestNeighbors () for the own points of a block; widens the block where needed.
/// \param rows   points of the working set, ascending
/// \param points number of points of the whole working set
CsrLists
findNearestOfBlock (BlockSearch& search, const Rows& rows, std::size_t points, int k,
                    const RunContext& run);

/// findNearestNeighbors () by the caller's search structure, in one thread. Ignores repeated and
/// unknown indices; the search may return fewer than k.
CsrLists
searchNearestNeighbors (CallerSearch& search, const Rows& rows, int k, const RunContext& run);

} // namespace pcl::floater
