// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighborhoods/ball_neighbors.h"

#include "common/parallel.h"
#include "neighborhoods/caller_search.h"

#include <cmath>
#include <memory>
#include <stdexcept>

namespace pcl
{
namespace floater
{
namespace
{
// Radius of the ball around a point, given its nearest others. A ball that holds fewer of them is
// widened to the farthest.
double
ballRadius (const std::vector<Neighbor>& nearest, double radius)
{
  double sum = 0.0;
  for (const Neighbor& neighbor : nearest)
    sum += std::sqrt (neighbor.sqr_distance);
  const double spacing = nearest.empty () ? 0.0 : sum / static_cast<double> (nearest.size ());
  // The square of a square root may be less than what it was made of.
  constexpr double ROUNDING = 1.0 + 1e-15;
  return nearest.empty ()
             ? 0.0
             : std::max (radius * spacing, ROUNDING * std::sqrt (nearest.back ().sqr_distance));
}

// The core's tree with the interface of CallerSearch.
class OwnSearch
{
public:
  explicit OwnSearch (const WorkingSet& set) : set_ (set), tree_ (set.positions) {}

  void nearest (Index p, std::size_t k, std::vector<Neighbor>& found) const
  {
    tree_.nearest (set_.positions[p], k + 1, found);
    drop (p, found);
  }
  void within (Index p, double radius, std::vector<Neighbor>& found) const
  {
    tree_.within (set_.positions[p], radius, found);
    drop (p, found);
  }

private:
  static void drop (Index p, std::vector<Neighbor>& found)
  {
    found.erase (std::find_if (found.begin (), found.end (),
                               [p] (const Neighbor& neighbor) { return neighbor.point == p; }));
  }

  const WorkingSet& set_;
  KdTree tree_;
};

template <typename Search>
FlatLists
searchBalls (std::size_t points, double radius, Search& search, int threads)
{
  FlatLists lists;
  lists.offsets.assign (points + 1, 0);
  // Each range collects its rows; then they are packed.
  std::vector<std::vector<Index>> ranges ((points + RANGE_LENGTH - 1) / RANGE_LENGTH);
  parallelRanges (points, threads, [&] (std::size_t first, std::size_t last) {
    std::vector<Neighbor> found;
    std::vector<Index>& range = ranges[first / RANGE_LENGTH];
    for (std::size_t point = first; point < last; ++point) {
      const auto p = static_cast<Index> (point);
      search.nearest (p, SPACING_NEIGHBORS, found);
      search.within (p, ballRadius (found, radius), found);
      const std::size_t count = std::min (found.size (), MOST_IN_BALL);
      for (std::size_t i = 0; i < count; ++i)
        range.push_back (found[i].point);
      lists.offsets[point + 1] = static_cast<Index> (count);
    }
  });
  std::size_t entries = 0;
  for (const std::vector<Index>& range : ranges)
    entries += range.size ();
  if (entries >= NONE)
    throw std::length_error (
        "the balls hold more than 32-bit indices can count: use fewer points or a smaller radius");
  for (std::size_t p = 0; p < points; ++p)
    lists.offsets[p + 1] += lists.offsets[p];
  lists.ids.reserve (entries);
  for (std::vector<Index>& range : ranges) {
    lists.ids.insert (lists.ids.end (), range.begin (), range.end ());
    std::vector<Index> ().swap (range);
  }
  return lists;
}

} // namespace

FlatLists
findBallNeighbors (const WorkingSet& set, double radius, NeighborSearch* search, int threads)
{
  if (search != nullptr) {
    CallerSearch by_caller (set, *search);
    return searchBalls (set.positions.size (), radius, by_caller, 1);
  }
  OwnSearch own (set);
  return searchBalls (set.positions.size (), radius, own, threads);
}

} // namespace floater
} // namespace pcl
