// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighborhoods/nearest_neighbors.h"

#include "common/parallel.h"
#include "neighborhoods/caller_search.h"

#include <algorithm>
#include <stdexcept>

namespace pcl
{
namespace floater
{
namespace
{
FlatLists
byKdTree (const WorkingSet& set, std::size_t k, int threads)
{
  const std::size_t n = set.positions.size ();
  FlatLists lists;
  lists.offsets.resize (n + 1);
  for (std::size_t p = 0; p <= n; ++p)
    lists.offsets[p] = static_cast<Index> (p * k);
  lists.ids.resize (n * k);
  const KdTree tree (set.positions, threads);
  parallelRanges (n, threads, [&] (std::size_t first, std::size_t last) {
    std::vector<Neighbor> found;
    found.reserve (k + 2);
    for (std::size_t p = first; p < last; ++p) {
      tree.nearest (set.positions[p], k + 1, found);
      Index* row = lists.ids.data () + p * k;
      for (const Neighbor& neighbor : found) // points are distinct: the point itself is among them
        if (neighbor.point != p)
          *row++ = neighbor.point;
    }
  });
  return lists;
}

FlatLists
bySearch (const WorkingSet& set, std::size_t k, NeighborSearch& search)
{
  const std::size_t n = set.positions.size ();
  CallerSearch by_caller (set, search);
  FlatLists lists;
  lists.offsets.reserve (n + 1);
  lists.offsets.push_back (0);
  lists.ids.reserve (n * k);
  std::vector<Neighbor> found;
  for (std::size_t p = 0; p < n; ++p) {
    by_caller.nearest (static_cast<Index> (p), k, found);
    for (const Neighbor& neighbor : found)
      lists.ids.push_back (neighbor.point);
    lists.offsets.push_back (static_cast<Index> (lists.ids.size ()));
  }
  return lists;
}

} // namespace

FlatLists
findNearestNeighbors (const WorkingSet& set, int k, NeighborSearch* search, int threads)
{
  const std::size_t wanted =
      std::min (static_cast<std::size_t> (k), std::max<std::size_t> (1, set.positions.size ()) - 1);
  if (set.positions.size () * wanted >= NONE)
    throw std::length_error (
        "points times neighbours exceed 32-bit indices: use fewer points or a smaller k");
  return search != nullptr ? bySearch (set, wanted, *search) : byKdTree (set, wanted, threads);
}

} // namespace floater
} // namespace pcl
