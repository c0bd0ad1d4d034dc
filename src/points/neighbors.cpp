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
  if (lists.rows () == 0)
    return lists;
  const std::size_t count = lists.offsets[1];
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Index> points;
    for (std::size_t i = first; i < last; ++i)
      points.push_back (rows[i]);
    SequentialSearch (tree, positions, count + 1)
        .search (points, [&] (std::size_t i, const std::vector<Neighbor>& found) {
          writeRow (found, points[i], count, lists.ids.data () + (first + i) * count);
        });
  });
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

namespace {
// Lists of what find (p, found) finds for each of the rows.
template <typename Find>
CsrLists
collectRows (const Rows& rows, const RunContext& run, const Find& find)
{
  CsrLists lists;
  lists.offsets.assign (rows.size () + 1, 0);
  RangeLists<Index> ranges (rows.size ());
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Neighbor> found;
    std::vector<Index>& range = ranges.of (first);
    for (std::size_t i = first; i < last; ++i) {
      find (rows[i], found);
      for (const Neighbor& neighbor : found)
        range.push_back (neighbor.point);
      lists.offsets[i + 1] = static_cast<Index> (found.size ());
    }
  });
  requireListed (ranges.size ());
  sumRowLengths (lists.offsets);
  lists.ids = ranges.join ();
  return lists;
}

// Radius of the ball around a point, given its nearest others. Widened to the farthest of them if
// needed.
double
ballRadius (const std::vector<Neighbor>& nearest, double radius)
{
  if (nearest.empty ())
    return 0.0;
  double sum = 0.0;
  for (const Neighbor& neighbor : nearest)
    sum += std::sqrt (neighbor.sqr_distance);
  const double spacing = sum / static_cast<double> (nearest.size ());
  constexpr double ROUNDING = 1.0 + 1e-15; // squaring a square root may round down
  return std::max (radius * spacing, ROUNDING * std::sqrt (nearest.back ().sqr_distance));
}

// The core's tree with the interface of CallerSearch. Bounded: beside a jump in density a ball may
// contain the whole cloud.
class TreeSearch
{
public:
  TreeSearch (const std::vector<Eigen::Vector3d>& positions, const RunContext& run)
      : positions_ (positions), tree_ (positions, run)
  {
  }

  void nearest (Index p, std::size_t k, std::vector<Neighbor>& found) const
  {
    search (p, KdTree::EVERYWHERE, k, found);
  }
  void within (Index p, double radius, std::vector<Neighbor>& found) const
  {
    search (p, radius, MOST_IN_BALL, found);
  }

private:
  void search (Index p, double radius, std::size_t most, std::vector<Neighbor>& found) const
  {
    const auto isOther = [p] (const Neighbor& neighbor, const auto&) {
      return neighbor.point != p;
    };
    tree_.nearestIf (positions_[p], Eigen::Vector3d::Zero (), radius, most, isOther, found);
  }

  const std::vector<Eigen::Vector3d>& positions_;
  KdTree tree_;
};

template <typename Search>
CsrLists
searchBalls (const Rows& rows, double radius, Search& search, const RunContext& run)
{
  return collectRows (rows, run, [&] (Index p, std::vector<Neighbor>& found) {
    search.nearest (p, SPACING_NEIGHBORS, found);
    search.within (p, ballRadius (found, radius), found);
    found.resize (std::min (found.size (), MOST_IN_BALL));
  });
}

} // namespace

CsrLists
searchNearestNeighbors (CallerSearch& search, const Rows& rows, int k, const RunContext& run)
{
  return collectRows (rows, run.withThreads (1), [&] (Index p, std::vector<Neighbor>& found) {
    search.nearest (p, static_cast<std::size_t> (k), found);
  });
}

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
// Number of blocks for a cloud: one up to 262144 points, otherwise blocks of at most 131072 points,
// the same number for every thread.
std::size_t
chooseBlocks (std::size_t points, int wanted, const RunContext& run)
{
  constexpr std::size_t BLOCK = 131072; // points: the halo then adds a tenth to the work
  if (wanted > 0)
    return static_cast<std::size_t> (wanted);
  if (points <= 2 * BLOCK)
    return 1;
  const auto at_once = static_cast<std::size_t> (run.threads ());
  return (points / BLOCK + at_once) / at_once * at_once;
}

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
  constexpr unsigned SHIFT = 12;
  const auto find = [gone = removed.data ()] (std::size_t begin, std::size_t end, std::size_t p) {
    return static_cast<std::size_t> (std::lower_bound (gone + begin, gone + end, p) - gone);
  };
  std::vector<std::size_t> starts; // number of removed points before every 4096th point
  for (std::size_t i = 0; i <= (points_before >> SHIFT) + 1; ++i)
    starts.push_back (find (0, removed.size (), i << SHIFT));
  // The new number of a point; NONE if it was removed.
  const auto after = [&] (Index p) {
    const std::size_t place = find (starts[p >> SHIFT], starts[(p >> SHIFT) + 1], p);
    return place < removed.size () && removed[place] == p ? NONE : p - static_cast<Index> (place);
  };
  const auto isGone = [&after] (Index p) { return after (p) == NONE; };
  std::vector<Index> changed; // points that lost a neighbour
  for (std::size_t r = 0; r < before.rows (); ++r) {
    const Row row = before.row (r);
    const Index p = after (first + static_cast<Index> (r));
    if (p != NONE && std::any_of (row.begin (), row.end (), isGone))
      changed.push_back (p);
  }
  const CsrLists renewed = search (Rows::of (changed));
  CsrLists lists;
  lists.offsets.reserve (before.rows () + 1);
  lists.offsets.push_back (0);
  lists.ids.reserve (before.ids.size ());
  std::size_t next = 0; // among the changed
  for (std::size_t r = 0; r < before.rows (); ++r) {
    const Index p = after (first + static_cast<Index> (r));
    if (p == NONE)
      continue;
    if (next < changed.size () && changed[next] == p) {
      const Row row = renewed.row (next++);
      lists.ids.insert (lists.ids.end (), row.begin (), row.end ());
    }
    else {
      for (const Index q : before.row (r))
        lists.ids.push_back (after (q));
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
