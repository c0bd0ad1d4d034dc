// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighborhoods/nearest_neighbors.h"

#include "common/parallel.h"
#include "neighborhoods/kd_tree.h"

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
  const KdTree tree (set.positions);
  parallelRanges (n, threads, [&] (std::size_t first, std::size_t last) {
    std::vector<Neighbor> found;
    found.reserve (k + 2);
    for (std::size_t p = first; p < last; ++p) {
      tree.nearest (set.positions[p], k + 1, found);
      Index* row = &lists.ids[p * k];
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
  std::vector<Index> sorted = set.cloud_index;
  std::sort (sorted.begin (), sorted.end ());
  std::vector<Index> point_of (n == 0 ? 0 : sorted.back () + std::size_t{1}, NONE);
  for (std::size_t p = 0; p < n; ++p)
    point_of[set.cloud_index[p]] = static_cast<Index> (p);

  search.build (sorted);
  FlatLists lists;
  lists.offsets.reserve (n + 1);
  lists.offsets.push_back (0);
  lists.ids.reserve (n * k);
  std::vector<Index> cloud_indices;
  std::vector<Neighbor> found;
  for (std::size_t p = 0; p < n; ++p) {
    search.nearest (set.cloud_index[p], static_cast<int> (k + 1), cloud_indices);
    found.clear ();
    for (Index cloud_index : cloud_indices)
      if (cloud_index < point_of.size () && point_of[cloud_index] != NONE &&
          point_of[cloud_index] != p) {
        const Index q = point_of[cloud_index];
        found.push_back ({(set.positions[q] - set.positions[p]).squaredNorm (), q});
      }
    std::sort (found.begin (), found.end ());
    found.erase (
        std::unique (found.begin (), found.end (),
                     [] (const Neighbor& a, const Neighbor& b) { return a.point == b.point; }),
        found.end ());
    for (std::size_t i = 0; i < std::min (k, found.size ()); ++i)
      lists.ids.push_back (found[i].point);
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
