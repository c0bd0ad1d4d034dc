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

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace pcl::floater {
/// Points to work on, ascending: all, a range, or a list. The list must outlive this.
class Rows
{
public:
  static Rows all (std::size_t points) { return {nullptr, 0, points}; }
  static Rows range (Index first, Index last) { return {nullptr, first, last - first}; }
  static Rows of (const std::vector<Index>& points) { return {points.data (), 0, points.size ()}; }

  std::size_t size () const { return count_; }
  Index operator[] (std::size_t i) const
  {
    return points_ ? points_[i] : first_ + static_cast<Index> (i);
  }

  /// Index of the first one that is not below `point`.
  std::size_t placeOf (Index point) const
  {
    return points_ ? static_cast<std::size_t> (std::lower_bound (points_, points_ + count_, point) -
                                               points_)
                   : std::min<std::size_t> (std::max (point, first_) - first_, count_);
  }

private:
  Rows (const Index* points, Index first, std::size_t count)
      : points_ (points), first_ (first), count_ (count)
  {
  }

  const Index* points_;
  Index first_; // if none are listed
  std::size_t count_;
};

/// Translates between points and cloud indices, and validates the answers: repeated and unknown
/// indices are ignored, distances are measured here. For one thread.
class CallerSearch
{
public:
  /// Builds the search on the points of the set. O(n log n) plus the time of the search.
  CallerSearch (const Points& points, NeighborSearch& search);

  /// The k nearest other points, nearest first, ties by index; fewer if the search finds fewer.
  void nearest (Index p, std::size_t k, std::vector<Neighbor>& found);

  /// The other points within `radius` (that distance included), nearest first, ties by index.
  void within (Index p, double radius, std::vector<Neighbor>& found);

private:
  void translate (Index p, std::vector<Neighbor>& found) const;

  const Points& points_;
  NeighborSearch& search_;
  std::vector<Index> point_of_;      // by cloud index
  std::vector<Index> cloud_indices_; // scratch: the answer of the search
};

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
CsrLists
findNearestOfBlock (BlockSearch& search, const Rows& rows, std::size_t points, int k,
                    const RunContext& run);

/// findNearestNeighbors () by the caller's search structure, in one thread. Ignores repeated and
/// unknown indices; the search may return fewer than k.
CsrLists
searchNearestNeighbors (CallerSearch& search, const Rows& rows, int k, const RunContext& run);

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
/// \param first         point of the first list, in the old numbering
/// \param removed       points in the old numbering, ascending
/// \param search        makes the lists of points in the new numbering, ascending
/// \return lists of the remaining points
CsrLists
renewRows (const CsrLists& before, Index first, std::size_t points_before,
           const std::vector<Index>& removed, const std::function<CsrLists (const Rows&)>& search);

/// Updates the neighbour lists of all points, like renewRows (). The result equals findNeighbors
/// ().
/// \param removed   points in the old numbering, ascending
CsrLists
renewNeighbors (const Points& points, const std::vector<Index>& removed, const CsrLists& neighbors,
                const NeighborSettings& settings, const RunContext& run);

} // namespace pcl::floater
