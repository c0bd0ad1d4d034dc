// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours of the points, by any search method.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/kd_tree.h"
#include "points/points.h"
#include "points/rows.h"

#include <pcl/surface/floater/reconstruct.h>

#include <functional>
#include <optional>

namespace pcl::floater {
/// Settings of the neighbour search.
struct NeighborSettings
{
  NeighborOptions options;
  int blocks = 0;                   ///< 0: chosen by the number of points
  NeighborSearch* search = nullptr; ///< of the caller; nullptr: the kd-tree of the core
};

/// Neighbours of every point, nearest first, by the working positions: the k nearest, or those in a
/// ball (sections 5 and 6 of TW 385: boundary and weights use the same).
/// \param tree out, if not nullptr: the kd-tree of all points; empty if none was built, as in
///     blocks
CsrLists
findNeighbors (const Points& points, const NeighborSettings& settings, const RunContext& run,
               std::optional<KdTree>* tree = nullptr);

/// Updates neighbour lists of consecutive points after points were removed: renumbers them, and
/// searches only for points that lost a neighbour.
/// \param before        lists before the removal
/// \param first         point of the first list, in the old numbering
/// \param points_before number of points of the whole working set
/// \param removed       points in the old numbering, ascending
/// \param search        makes the lists of points in the new numbering, ascending
/// \return lists of the remaining points
CsrLists
renewRows (const CsrLists& before, Index first, std::size_t points_before,
           const std::vector<Index>& removed, const std::function<CsrLists (const Rows&)>& search);

/// Updates the neighbour lists of all points, like renewRows (). The result equals findNeighbors
/// ().
/// \param points    after the removal
/// \param removed   points in the old numbering, ascending
/// \param neighbors lists before the removal
CsrLists
renewNeighbors (const Points& points, const std::vector<Index>& removed, const CsrLists& neighbors,
                const NeighborSettings& settings, const RunContext& run);

} // namespace pcl::floater
