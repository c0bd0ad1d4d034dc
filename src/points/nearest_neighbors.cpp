// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/nearest_neighbors.h"

#include "core/parallel.h"
#include "points/point_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl
{
namespace floater
{
namespace
{
// Above one by more than the rounding of a sum of distances.
constexpr double SAFELY = 1.0 + 1e-9;

// For the message that there are too many.
constexpr const char* TABLE = "the table of neighbours";
constexpr const char* REMEDY = "use fewer points or fewer neighbours";

// Writes the k nearest points of one of them but for itself, and NONE for those that are missing.
// Points whose squared distance to it underflows may push it out of the results.
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
    std::vector<Neighbor> found;
    found.reserve (k + 2);
    for (std::size_t i = first; i < last; ++i) {
      tree.nearest (positions[rows[i]], k + 1, found);
      writeRow (found, rows[i], k, ids.data () + i * k);
    }
  });
}

// Searches for the rows from `begin` to before `end` within a block. Balls in which points outside
// of it may be nearer are added to `missing`.
void
searchBlock (const PointBlock& block, const std::vector<Eigen::Vector3d>& positions,
             const Rows& rows, std::size_t begin, std::size_t end, std::size_t k,
             const RunContext& run, std::vector<Index>& ids, std::vector<Ball>& missing)
{
  const KdTree tree (block.positions, run);
  ProgressLoop progress (run);
  std::vector<Neighbor> found;
  found.reserve (k + 2);
  const auto isHere = [&block] (const Eigen::Vector3d& centre, double reach) {
    return reach * SAFELY <= block.halo ||
           std::any_of (block.balls.begin (), block.balls.end (), [&] (const Ball& ball) {
             return ((ball.centre - centre).norm () + reach) * SAFELY <= ball.radius;
           });
  };
  for (std::size_t i = begin; i < end; ++i) {
    progress.next ();
    const Eigen::Vector3d& centre = positions[rows[i]];
    tree.nearest (centre, k + 1, found);
    constexpr double EVERYWHERE = 1e100;
    const double reach =
        found.size () == k + 1 ? std::sqrt (found.back ().sqr_distance) : EVERYWHERE;
    if (!isHere (centre, reach))
      missing.push_back ({centre, reach * SAFELY * SAFELY});
    for (Neighbor& neighbor : found)
      neighbor.point = block.points[neighbor.point];
    writeRow (found, rows[i], k, ids.data () + i * k);
  }
}

// Lists of k neighbours, or of all others if there are fewer, still to be filled in.
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
    std::vector<Ball> balls, missing;
    for (bool again = begin < end; again; again = !missing.empty ()) {
      balls.insert (balls.end (), missing.begin (), missing.end ());
      missing.clear ();
      searchBlock (cutter.cut (block, balls), positions, rows, begin, end, count,
                   run.withThreads (1), lists.ids, missing);
    }
  });
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

} // namespace floater
} // namespace pcl
