// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/neighbors.h"

#include "points/ball_neighbors.h"
#include "points/nearest_neighbors.h"
#include "points/point_block.h"

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
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
  tree->emplace (positions, run);
  return findNearestNeighbors (positions, rows, settings.options.k, **tree, run);
}

// Row of each point after points were removed; NONE for these.
std::vector<Index>
rowsAfterRemoval (std::size_t points_before, const std::vector<Index>& removed)
{
  std::vector<Index> row_after (points_before);
  Index next = 0;
  auto gone = removed.begin ();
  for (Index p = 0; p < points_before; ++p) {
    const bool is_gone = gone != removed.end () && *gone == p;
    row_after[p] = is_gone ? NONE : next++;
    gone += is_gone ? 1 : 0;
  }
  return row_after;
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
renewNeighbors (const Points& points, const std::vector<Index>& removed, const CsrLists& neighbors,
                const NeighborSettings& settings, const RunContext& run)
{
  const std::vector<Index> row_after = rowsAfterRemoval (neighbors.rows (), removed);
  std::vector<Index> changed; // points that lost a neighbour
  for (Index p = 0; p < row_after.size (); ++p) {
    const Row row = neighbors.row (p);
    if (row_after[p] != NONE &&
        std::any_of (row.begin (), row.end (), [&] (Index q) { return row_after[q] == NONE; }))
      changed.push_back (row_after[p]);
  }
  const CsrLists renewed = findNeighborsOf (Rows::of (changed), points, settings, run);
  CsrLists lists;
  lists.offsets.reserve (points.size () + 1);
  lists.offsets.push_back (0);
  lists.ids.reserve (neighbors.ids.size ());
  std::size_t next = 0; // among the changed
  for (Index p = 0; p < row_after.size (); ++p) {
    if (row_after[p] == NONE)
      continue;
    if (next < changed.size () && changed[next] == row_after[p]) {
      const Row row = renewed.row (next++);
      lists.ids.insert (lists.ids.end (), row.begin (), row.end ());
    }
    else {
      for (const Index q : neighbors.row (p))
        lists.ids.push_back (row_after[q]);
    }
    lists.offsets.push_back (static_cast<Index> (lists.ids.size ()));
  }
  return lists;
}

} // namespace floater
} // namespace pcl
