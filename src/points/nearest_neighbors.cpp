// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/nearest_neighbors.h"

#include "core/parallel.h"
#include "points/point_block.h"
#include "points/sequential_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
// For error messages.
constexpr const char* TABLE = "the table of neighbours";
constexpr const char* REMEDY = "use fewer points or fewer neighbours";

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
  requireCountable (rows * count, NONE - 1, TABLE, REMEDY);
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
    requireCountable (lists.ids.size (), NONE - 1, TABLE, REMEDY);
    lists.offsets.push_back (static_cast<Index> (lists.ids.size ()));
  }
  return lists;
}

} // namespace pcl::floater
