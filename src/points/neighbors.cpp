// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/neighbors.h"

#include "core/parallel.h"
#include "points/kd_tree.h"
#include "points/point_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
// Writes the k nearest points of `self` without itself, and NONE for missing ones. Points whose
// squared distance underflows may push it out of the results.
void
writeRow (const std::vector<Neighbor>& found, Index self, std::size_t k, Index* row)
{
  std::size_t count = 0;
  for (const Neighbor& neighbor : found)
    if (neighbor.point != self && count < k)
      row[count++] = neighbor.point;
  std::fill (row + count, row + k, NONE);
}

void
searchWhole (const std::vector<Eigen::Vector3d>& positions, const Rows& rows, std::size_t k,
             const KdTree& tree, const RunContext& run, std::vector<Index>& ids)
{
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Index> points;
    for (std::size_t i = first; i < last; ++i)
      points.push_back (rows[i]);
    SequentialSearch (tree, positions, k + 1)
        .search (points, [&] (std::size_t i, const std::vector<Neighbor>& found) {
          writeRow (found, points[i], k, ids.data () + (first + i) * k);
        });
  });
}

// Searches for the rows from `begin` to before `end`, which are own points of the block.
void
searchBlock (BlockSearch& search, const Rows& rows, std::size_t begin, std::size_t end,
             std::size_t k, const RunContext& run, Index* ids)
{
  const PointBlock& block = search.block ();
  const KdTree& tree = search.tree ();
  parallelRanges (run, end - begin, [&] (std::size_t first, std::size_t last) {
    std::vector<Index> places;
    Index place = block.placeOf (rows[begin + first]);
    for (std::size_t i = begin + first; i < begin + last; ++i) {
      while (block.points[place] < rows[i])
        ++place;
      places.push_back (place);
    }
    std::vector<Neighbor> named;
    SequentialSearch (tree, block.positions, k + 1)
        .search (places, [&] (std::size_t i, const std::vector<Neighbor>& found) {
          tree.lookedForNearest (block.positions[places[i]], k + 1, found);
          named = found;
          for (Neighbor& neighbor : named)
            neighbor.point = block.points[neighbor.point];
          writeRow (named, block.points[places[i]], k, ids + (first + i) * k);
        });
  });
}

// Lists of k neighbours, or of all others if there are fewer; not yet filled.
CsrLists
emptyLists (std::size_t points, std::size_t rows, int k)
{
  const std::size_t count =
      std::min (static_cast<std::size_t> (k), std::max<std::size_t> (1, points) - 1);
  requireListed (rows * count);
  CsrLists lists;
  lists.offsets.resize (rows + 1);
  for (std::size_t i = 0; i <= rows; ++i)
    lists.offsets[i] = static_cast<Index> (i * count);
  lists.ids.reserve (rows * count + rows); // far neighbours may be appended, see appendRows
  lists.ids.resize (rows * count);
  return lists;
}

} // namespace

CsrLists
findNearestNeighbors (const std::vector<Eigen::Vector3d>& positions, const Rows& rows, int k,
                      const KdTree& tree, const RunContext& run)
{
  CsrLists lists = emptyLists (positions.size (), rows.size (), k);
  if (lists.rows () > 0)
    searchWhole (positions, rows, lists.offsets[1], tree, run, lists.ids);
  return lists;
}

CsrLists
findNearestNeighbors (const std::vector<Eigen::Vector3d>& positions, const Rows& rows, int k,
                      std::size_t blocks, const RunContext& run)
{
  if (blocks < 2)
    return findNearestNeighbors (positions, rows, k, KdTree (positions, run), run);
  CsrLists lists = emptyLists (positions.size (), rows.size (), k);
  if (lists.rows () == 0)
    return lists;
  const std::size_t count = lists.offsets[1];
  const BlockCutter cutter (positions, blocks, run);
  parallelTasks (run, cutter.blocks (), [&] (std::size_t block) {
    const std::size_t begin = rows.placeOf (cutter.first (block));
    const std::size_t end = rows.placeOf (cutter.last (block));
    if (begin == end)
      return;
    const RunContext alone = run.withThreads (1);
    BlockSearch search (cutter, block, alone);
    do
      searchBlock (search, rows, begin, end, count, alone, lists.ids.data () + begin * count);
    while (search.widen ());
  });
  return lists;
}

CsrLists
findNearestOfBlock (BlockSearch& search, const Rows& rows, std::size_t points, int k,
                    const RunContext& run)
{
  CsrLists lists = emptyLists (points, rows.size (), k);
  if (lists.rows () == 0)
    return lists;
  do
    searchBlock (search, rows, 0, rows.size (), lists.offsets[1], run, lists.ids.data ());
  while (search.widen ());
  return lists;
}

CsrLists
searchNearestNeighbors (CallerSearch& search, const Rows& rows, int k, const RunContext& run)
{
  CsrLists lists;
  lists.offsets.reserve (rows.size () + 1);
  lists.offsets.push_back (0);
  std::vector<Neighbor> found;
  ProgressLoop progress (run, rows.size ());
  for (std::size_t i = 0; i < rows.size (); ++i) {
    progress.next ();
    search.nearest (rows[i], static_cast<std::size_t> (k), found);
    for (const Neighbor& neighbor : found)
      lists.ids.push_back (neighbor.point);
    requireListed (lists.ids.size ());
    lists.offsets.push_back (static_cast<Index> (lists.ids.size ()));
  }
  return lists;
}

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
  RangeLists<Index> ranges (rows.size ());
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Neighbor> found;
    std::vector<Index>& range = ranges.of (first);
    for (std::size_t i = first; i < last; ++i) {
      search.nearest (rows[i], SPACING_NEIGHBORS, found);
      search.within (rows[i], ballRadius (found, radius), found);
      const std::size_t count = std::min (found.size (), MOST_IN_BALL);
      for (std::size_t n = 0; n < count; ++n)
        range.push_back (found[n].point);
      lists.offsets[i + 1] = static_cast<Index> (count);
    }
  });
  requireCountable (ranges.size (), NONE - 1, "the table of neighbours in balls",
                    "use fewer points or a smaller radius");
  sumRowLengths (lists.offsets);
  lists.ids = ranges.join ();
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

CallerSearch::CallerSearch (const Points& points, NeighborSearch& search)
    : points_ (points), search_ (search)
{
  std::vector<Index> sorted = points.cloud_index;
  std::sort (sorted.begin (), sorted.end ());
  point_of_.assign (sorted.empty () ? 0 : sorted.back () + std::size_t{1}, NONE);
  for (std::size_t p = 0; p < points.cloud_index.size (); ++p)
    point_of_[points.cloud_index[p]] = static_cast<Index> (p);
  search.build (sorted);
}

void
CallerSearch::translate (Index p, std::vector<Neighbor>& found) const
{
  const std::vector<Eigen::Vector3d>& positions = points_.workingPositions ();
  found.clear ();
  for (const Index cloud_index : cloud_indices_)
    if (cloud_index < point_of_.size () && point_of_[cloud_index] != NONE &&
        point_of_[cloud_index] != p) {
      const Index q = point_of_[cloud_index];
      found.push_back ({(positions[q] - positions[p]).squaredNorm (), q});
    }
  std::sort (found.begin (), found.end ());
  found.erase (
      std::unique (found.begin (), found.end (),
                   [] (const Neighbor& a, const Neighbor& b) { return a.point == b.point; }),
      found.end ());
}

void
CallerSearch::nearest (Index p, std::size_t k, std::vector<Neighbor>& found)
{
  search_.nearest (points_.cloud_index[p], static_cast<int> (k + 1), cloud_indices_);
  translate (p, found);
  found.resize (std::min (k, found.size ()));
}

void
CallerSearch::within (Index p, double radius, std::vector<Neighbor>& found)
{
  // Searches of PCL compute in single precision: search a little farther, then measure.
  constexpr double MORE = 1.0 + 1e-5;
  const double sqr_radius = radius * radius;
  const auto is_outside = [sqr_radius] (const Neighbor& neighbor) {
    return neighbor.sqr_distance > sqr_radius;
  };
  if (search_.within (points_.cloud_index[p], MORE * points_.scale * radius, cloud_indices_))
    translate (p, found);
  else
    for (std::size_t k = 32;; k *= 2) {
      nearest (p, std::min (k, points_.positions.size ()), found);
      if (found.size () < k || is_outside (found.back ()))
        break;
    }
  found.erase (std::find_if (found.begin (), found.end (), is_outside), found.end ());
}

namespace {
CsrLists
findNeighborsOf (const Rows& rows, const Points& points, const NeighborSettings& settings,
                 const RunContext& run, std::optional<KdTree>* tree = nullptr)
{
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  const bool in_balls = settings.options.kind == Neighborhood::BALL ||
                        settings.options.kind == Neighborhood::BALL_DELAUNAY;
  if (settings.search != nullptr) {
    CallerSearch search (points, *settings.search);
    return in_balls ? searchBallNeighbors (search, rows, settings.options.ball_radius, run)
                    : searchNearestNeighbors (search, rows, settings.options.k, run);
  }
  if (in_balls)
    return findBallNeighbors (positions, rows, settings.options.ball_radius, run);
  const std::size_t blocks = chooseBlocks (positions.size (), settings.blocks, run);
  if (tree == nullptr || blocks > 1)
    return findNearestNeighbors (positions, rows, settings.options.k, blocks, run);
  tree->emplace (positions, run, PointOrder::ALONG_CURVE);
  return findNearestNeighbors (positions, rows, settings.options.k, **tree, run);
}

// New numbers of points after a removal.
class Renumbering
{
public:
  // \param removed ascending; must outlive this
  Renumbering (const std::vector<Index>& removed, std::size_t points_before) : removed_ (removed)
  {
    starts_.reserve ((points_before >> SHIFT) + 2);
    for (std::size_t i = 0, first = 0; i <= points_before >> SHIFT; ++i) {
      while (first < removed.size () && removed[first] < i << SHIFT)
        ++first;
      starts_.push_back (first);
    }
    starts_.push_back (removed.size ());
  }

  // NONE for removed points.
  Index after (Index p) const
  {
    const auto begin = removed_.begin ();
    const auto place =
        std::lower_bound (begin + static_cast<std::ptrdiff_t> (starts_[p >> SHIFT]),
                          begin + static_cast<std::ptrdiff_t> (starts_[(p >> SHIFT) + 1]), p);
    return place != removed_.end () && *place == p ? NONE : p - static_cast<Index> (place - begin);
  }

private:
  static constexpr unsigned SHIFT = 12;

  const std::vector<Index>& removed_;
  std::vector<std::size_t> starts_; // number of removed points before every 4096th point
};

} // namespace

CsrLists
findNeighbors (const Points& points, const NeighborSettings& settings, const RunContext& run,
               std::optional<KdTree>* tree)
{
  if (tree != nullptr)
    tree->reset ();
  return findNeighborsOf (Rows::all (points.size ()), points, settings, run, tree);
}

CsrLists
renewRows (const CsrLists& before, Index first, std::size_t points_before,
           const std::vector<Index>& removed, const std::function<CsrLists (const Rows&)>& search)
{
  const Renumbering renumbering (removed, points_before);
  std::vector<Index> changed; // points that lost a neighbour
  for (std::size_t r = 0; r < before.rows (); ++r) {
    const Row row = before.row (r);
    const Index p = renumbering.after (first + static_cast<Index> (r));
    if (p != NONE && std::any_of (row.begin (), row.end (),
                                  [&] (Index q) { return renumbering.after (q) == NONE; }))
      changed.push_back (p);
  }
  const CsrLists renewed = search (Rows::of (changed));
  CsrLists lists;
  lists.offsets.reserve (before.rows () + 1);
  lists.offsets.push_back (0);
  lists.ids.reserve (before.ids.size ());
  std::size_t next = 0; // among the changed
  for (std::size_t r = 0; r < before.rows (); ++r) {
    const Index p = renumbering.after (first + static_cast<Index> (r));
    if (p == NONE)
      continue;
    if (next < changed.size () && changed[next] == p) {
      const Row row = renewed.row (next++);
      lists.ids.insert (lists.ids.end (), row.begin (), row.end ());
    }
    else {
      for (const Index q : before.row (r))
        lists.ids.push_back (renumbering.after (q));
    }
    lists.offsets.push_back (static_cast<Index> (lists.ids.size ()));
  }
  return lists;
}

CsrLists
renewNeighbors (const Points& points, const std::vector<Index>& removed, const CsrLists& neighbors,
                const NeighborSettings& settings, const RunContext& run)
{
  return renewRows (neighbors, 0, neighbors.rows (), removed, [&] (const Rows& rows) {
    return findNeighborsOf (rows, points, settings, run);
  });
}

} // namespace pcl::floater
