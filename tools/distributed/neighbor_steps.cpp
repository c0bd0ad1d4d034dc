// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "block_steps.h"

#include "cloud_geometry.h"
#include "points/neighbors.h"
#include "points/outliers.h"
#include "stored_cloud.h"

#include <algorithm>

namespace pcl::floater {
namespace {
constexpr double HALO = 1.0; // width, see BlockCutter: neighbours are nearer
constexpr std::size_t POINTS_OF_APART = 20, REACH_OF = 6; // neighbours that findApart looks at

// Whether points lie apart. The reach of the points around is needed, and these may be of other
// blocks.
std::vector<std::uint8_t>
findOwnApart (const std::vector<Index>& own, const CsrLists& neighbors, BlockSearch& search,
              const StepContext& context)
{
  struct Other
  {
    Index point, owner; // a point of another block, and an own one that it is a neighbour of
  };
  std::vector<Other> others;
  for (std::size_t i = 0; i < own.size (); ++i)
    for (const Index q : neighbors.first (i, POINTS_OF_APART))
      if (q < own.front () || q > own.back ())
        others.push_back ({q, own[i]});
  std::stable_sort (others.begin (), others.end (),
                    [] (const Other& a, const Other& b) { return a.point < b.point; });
  others.erase (std::unique (others.begin (), others.end (),
                             [] (const Other& a, const Other& b) { return a.point == b.point; }),
                others.end ());
  std::vector<Index> rows = own;
  for (const Other& other : others)
    rows.push_back (other.point);
  sortUnique (rows);
  CsrLists lists;
  lookUntilInside (search, [&] (const LocalPoints& local,
                                const std::vector<Eigen::Vector3d>& positions) {
    lists = {};
    lists.offsets.push_back (0);
    std::vector<Neighbor> found;
    auto other = others.begin ();
    for (const Index p : rows) {
      if (other == others.end () || other->point != p) {
        const Row row = neighbors.row (p - own.front ());
        lists.ids.insert (lists.ids.end (), row.begin (), row.end ());
      }
      else {
        const Eigen::Vector3d& here = positions[local.placeOf (p)];
        search.tree ().nearest (here, REACH_OF + 1, found);
        const Eigen::Vector3d& owner = positions[local.placeOf (other->owner)];
        search.watch ().looked (owner, found.size () == REACH_OF + 1
                                           ? (here - owner).norm () +
                                                 std::sqrt (found.back ().sqr_distance)
                                           : KdTree::EVERYWHERE);
        std::size_t count = 0;
        for (const Neighbor& neighbor : found)
          if (const Index q = search.block ().points[neighbor.point]; q != p && count < REACH_OF) {
            lists.ids.push_back (q);
            ++count;
          }
        ++other;
      }
      lists.offsets.push_back (static_cast<Index> (lists.ids.size ()));
    }
  });
  const LocalPoints local (search.block ().points);
  const CsrLists places = local.toPlaces (rows, lists);
  local.toPlaces (rows);
  std::vector<float> reach (local.size (), 0.0F);
  const std::vector<Eigen::Vector3d>& positions = search.block ().positions;
  findReaches (positions, places, Rows::of (rows), reach, context.run);
  return findApart (positions, places, reach, Rows::range (search.ownFirst (), search.ownLast ()),
                    context.limits.outliers, context.run);
}

} // namespace

void
neighborsStep (const StepContext& context, std::size_t block)
{
  StoredCloud cloud (context, {}, true);
  const Index first = cloud.ranges ().first (block), last = cloud.ranges ().last (block);
  ArrayWriter writer;
  CsrLists neighbors;
  std::vector<std::uint8_t> apart;
  std::vector<std::uint64_t> count (1, 0);
  if (first < last) {
    BlockSearch search (cloud.cutter (), block, context.run, HALO);
    neighbors = findNearestOfBlock (search, Rows::range (first, last), cloud.points (),
                                    context.options.neighbors.k, context.run);
    if (context.options.remove_outliers &&
        mayHaveOutliers (cloud.points (), context.limits.outliers))
      apart = findOwnApart (pointsFrom (first, last), neighbors, search, context);
    count[0] = static_cast<std::uint64_t> (std::count (apart.begin (), apart.end (), 1));
  }
  writer.add ("ids", neighbors.ids);
  writer.add ("apart", apart);
  writer.add ("apart_count", count);
  context.store.put (blockFile ("neighbors", block), writer, context.plan.id);
}

void
chooseOutliersStep (const StepContext& context)
{
  const std::size_t n = context.plan.points;
  const BlockRanges ranges = blockRanges (context.plan, n);
  Slices found (context.store, context.plan, ranges, "neighbors");
  std::uint64_t apart_count = 0;
  for (std::size_t block = 0; block < ranges.blocks (); ++block)
    apart_count += found.file (block).read<std::uint64_t> ("apart_count").front ();
  std::vector<Index> outliers;
  if (apart_count > 0) {
    const std::size_t k =
        std::min<std::size_t> (static_cast<std::size_t> (context.options.neighbors.k), n - 1);
    const std::size_t own = std::min (k, context.limits.outliers.own);
    std::vector<std::uint8_t> apart;
    apart.reserve (n);
    CsrLists neighbors; // the nearest of each
    neighbors.offsets.resize (n + 1);
    for (std::size_t p = 0; p <= n; ++p)
      neighbors.offsets[p] = static_cast<Index> (p * own);
    neighbors.findWraps ();
    neighbors.ids.reserve (n * own);
    for (std::size_t block = 0; block < ranges.blocks (); ++block) {
      const std::vector<Index> ids = found.file (block).read<Index> ("ids");
      for (std::size_t i = 0; i < ids.size (); i += k)
        neighbors.ids.insert (neighbors.ids.end (), ids.begin () + static_cast<std::ptrdiff_t> (i),
                              ids.begin () + static_cast<std::ptrdiff_t> (i + own));
      const std::vector<std::uint8_t> flags = found.file (block).read<std::uint8_t> ("apart");
      apart.insert (apart.end (), flags.begin (), flags.end ());
    }
    outliers = chooseOutliers (neighbors, std::move (apart), context.limits.outliers);
  }
  if (!outliers.empty ()) {
    std::vector<Index> gross_outliers;
    Points points = readPoints (context.store, POINTS, context.plan, gross_outliers);
    removePoints (points, outliers);
    writePoints (context.store, POINTS_LEFT, context.plan.id, points, gross_outliers, context.run);
  }
  ArrayWriter writer;
  writer.add ("outliers", outliers);
  context.store.put (OUTLIERS, writer, context.plan.id);
}

} // namespace pcl::floater
