// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours of points: the nearest, those in a ball, those of the caller's search.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "core/types.h"
#include "points/kd_tree.h"
#include "points/point_block.h"
#include "points/points.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// Points to work on, ascending: all, a range, or a list. The list must outlive this.
struct Rows
{
  static Rows all (std::size_t points) { return {nullptr, 0, points}; }
  static Rows range (Index begin, Index end) { return {nullptr, begin, end - begin}; }
  static Rows of (const std::vector<Index>& points) { return {points.data (), 0, points.size ()}; }

  std::size_t size () const { return count; }
  Index operator[] (std::size_t i) const
  {
    return listed ? listed[i] : first + static_cast<Index> (i);
  }

  const Index* listed; ///< nullptr: those from the first on
  Index first;
  std::size_t count;
};

/// The k nearest other points of the points in `rows`, nearest first, ties by index; fewer if there
/// are no more. Row i belongs to rows[i]. O(n log n).
/// \throws IndexLimitReached if there are 2^32 - 1 entries or more
CsrLists
findNearestNeighbors (const Positions& positions, const Rows& rows, int k, const RunContext& run);

/// findNearestNeighbors () for the own points of a block; widens the block where needed.
/// \param points of the whole cloud
CsrLists
findNearestOfBlock (BlockSearch& search, std::size_t points, int k, const RunContext& run);

/// Neighbours in the mean distance that is the local spacing; also the minimum in a ball.
constexpr std::size_t SPACING_NEIGHBORS = 6;

/// Mean distance of a point to its SPACING_NEIGHBORS nearest, by its row; 0 if it has no neighbours.
double
spacingOf (const Positions& positions, Index p, const Row& row);

/// Local spacing: spacingOf each point; on a regular triangulation, the length of an edge. O(n).
/// \param neighbors nearest first
std::vector<float>
localSpacing (const Positions& positions, const CsrLists& neighbors, const RunContext& run);

inline bool
isInBalls (Neighborhood kind)
{
  return kind == Neighborhood::BALL || kind == Neighborhood::BALL_DELAUNAY;
}

/// Settings of the neighbour search.
struct NeighborSettings
{
  NeighborOptions options;
  NeighborSearch* search = nullptr; ///< of the caller; nullptr: the kd-tree of the core
};

/// Neighbours of every point by the working positions, nearest first, ties by index: the k nearest,
/// or those in a ball (sections 5 and 6 of TW 385: boundary and weights use the same). The radius is
/// relative to the mean distance to the SPACING_NEIGHBORS nearest; at least these, and at most the
/// nearest 200. Of the caller's search, repeated and unknown indices are ignored, and distances are
/// measured here; it may find fewer.
/// \param tree out, if not nullptr: the kd-tree of all points; empty if none was built
/// \throws IndexLimitReached if there are 2^32 - 1 entries or more
CsrLists
findNeighbors (const Points& points, const NeighborSettings& settings, const RunContext& run,
               std::optional<KdTree>* tree = nullptr);

/// Updates neighbour lists after points were removed: renumbers them, and searches only for points
/// that lost a neighbour. O(n k) plus the search. The result equals findNeighbors ().
/// \param points    those that remain
/// \param removed   points in the old numbering, ascending
CsrLists
renewNeighbors (const Points& points, const std::vector<Index>& removed, const CsrLists& neighbors,
                const NeighborSettings& settings, const RunContext& run);

} // namespace pcl::floater
