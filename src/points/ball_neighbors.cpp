// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/ball_neighbors.h"

#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
// Radius of the ball around a point, given its nearest others. Widened to the farthest of them if
// needed.
double
ballRadius (const std::vector<Neighbor>& nearest, double radius)
{
  double sum = 0.0;
  for (const Neighbor& neighbor : nearest)
    sum += std::sqrt (neighbor.sqr_distance);
  const double spacing = nearest.empty () ? 0.0 : sum / static_cast<double> (nearest.size ());
  // Squaring a square root may round down.
  constexpr double ROUNDING = 1.0 + 1e-15;
  return nearest.empty ()
             ? 0.0
             : std::max (radius * spacing, ROUNDING * std::sqrt (nearest.back ().sqr_distance));
}

// The core's tree with the interface of CallerSearch.
class TreeSearch
{
public:
  TreeSearch (const std::vector<Eigen::Vector3d>& positions, const RunContext& run)
      : positions_ (positions), tree_ (positions, run)
  {
  }

  void nearest (Index p, std::size_t k, std::vector<Neighbor>& found) const
  {
    tree_.nearest (positions_[p], k + 1, found);
    drop (p, found);
    found.resize (std::min (k, found.size ()));
  }
  // Bounded: beside a jump in density the ball may contain the whole cloud.
  void within (Index p, double radius, std::vector<Neighbor>& found) const
  {
    tree_.nearestIf (
        positions_[p], Eigen::Vector3d::Zero (), radius, MOST_IN_BALL,
        [p] (const Neighbor& neighbor, const Eigen::Vector3d& /*position*/) {
          return neighbor.point != p;
        },
        found);
  }

private:
  static void drop (Index p, std::vector<Neighbor>& found)
  {
    found.erase (std::remove_if (found.begin (), found.end (),
                                 [p] (const Neighbor& neighbor) { return neighbor.point == p; }),
                 found.end ());
  }

  const std::vector<Eigen::Vector3d>& positions_;
  KdTree tree_;
};

template <typename Search>
CsrLists
searchBalls (const Rows& rows, double radius, Search& search, const RunContext& run)
{
  CsrLists lists;
  lists.offsets.assign (rows.size () + 1, 0);
  // Each range collects its rows; then they are packed.
  std::vector<std::vector<Index>> ranges ((rows.size () + RANGE_LENGTH - 1) / RANGE_LENGTH);
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Neighbor> found;
    std::vector<Index>& range = ranges[first / RANGE_LENGTH];
    for (std::size_t i = first; i < last; ++i) {
      search.nearest (rows[i], SPACING_NEIGHBORS, found);
      search.within (rows[i], ballRadius (found, radius), found);
      const std::size_t count = std::min (found.size (), MOST_IN_BALL);
      for (std::size_t n = 0; n < count; ++n)
        range.push_back (found[n].point);
      lists.offsets[i + 1] = static_cast<Index> (count);
    }
  });
  std::size_t entries = 0;
  for (const std::vector<Index>& range : ranges)
    entries += range.size ();
  requireCountable (entries, NONE - 1, "the table of neighbours in balls",
                    "use fewer points or a smaller radius");
  sumRowLengths (lists.offsets);
  lists.ids.reserve (entries);
  for (std::vector<Index>& range : ranges) {
    lists.ids.insert (lists.ids.end (), range.begin (), range.end ());
    std::vector<Index> ().swap (range);
  }
  return lists;
}

} // namespace

CsrLists
findBallNeighbors (const std::vector<Eigen::Vector3d>& positions, const Rows& rows, double radius,
                   const RunContext& run)
{
  TreeSearch search (positions, run);
  return searchBalls (rows, radius, search, run);
}

CsrLists
searchBallNeighbors (CallerSearch& search, const Rows& rows, double radius, const RunContext& run)
{
  return searchBalls (rows, radius, search, run.withThreads (1));
}

} // namespace pcl::floater
