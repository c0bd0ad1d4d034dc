// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours of the points, however they are searched.
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
/// How neighbours are searched.
struct NeighborSettings
{
  NeighborOptions options;
  int blocks = 0;                   ///< 0: chosen by the number of points
  NeighborSearch* search = nullptr; ///< of the caller's; nullptr: the core's kd-tree
};

/// Neighbours of every point, nearest first, by the working positions: the k nearest, or those in a
/// ball (sections 5 and 6 of TW 385: the same serve boundary and weights).
/// \param tree out, if not nullptr: the kd-tree of all points, for later searches; none where the
///             search needed none, as in blocks
CsrLists
findNeighbors (const Points& points, const NeighborSettings& settings, const RunContext& run,
               std::optional<KdTree>* tree = nullptr);

/// Makes neighbour lists of consecutive points right again after points were removed: renumbers
/// them, and searches anew only for points that had one of the removed as a neighbour.
/// \param before        the lists before
/// \param first         the point of the first list, as it was numbered before
/// \param points_before of the whole working set
/// \param removed       points before they were removed, ascending
/// \param search        makes the lists of points that are numbered as they are now, ascending
/// \return the lists of those of the points that are left
CsrLists
renewRows (const CsrLists& before, Index first, std::size_t points_before,
           const std::vector<Index>& removed, const std::function<CsrLists (const Rows&)>& search);

/// Makes neighbour lists right again after points were removed: renumbers them, and searches anew
/// only for points that had one of the removed as a neighbour. The result is that of
/// findNeighbors ().
/// \param points    without those that were removed
/// \param removed   rows before they were removed, ascending
/// \param neighbors those before
CsrLists
renewNeighbors (const Points& points, const std::vector<Index>& removed, const CsrLists& neighbors,
                const NeighborSettings& settings, const RunContext& run);

} // namespace pcl::floater
