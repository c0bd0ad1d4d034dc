// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/neighbors.h"

#include "points/ball_neighbors.h"
#include "points/nearest_neighbors.h"
#include "points/point_block.h"

#include <algorithm>

namespace pcl::floater {
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
