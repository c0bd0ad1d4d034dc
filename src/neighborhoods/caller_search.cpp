// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighborhoods/caller_search.h"

#include <algorithm>

namespace pcl
{
namespace floater
{
CallerSearch::CallerSearch (const WorkingSet& set, NeighborSearch& search)
    : set_ (set), search_ (search)
{
  std::vector<Index> sorted = set.cloud_index;
  std::sort (sorted.begin (), sorted.end ());
  point_of_.assign (sorted.empty () ? 0 : sorted.back () + std::size_t{1}, NONE);
  for (std::size_t p = 0; p < set.cloud_index.size (); ++p)
    point_of_[set.cloud_index[p]] = static_cast<Index> (p);
  search.build (sorted);
}

void
CallerSearch::translate (Index p, std::vector<Neighbor>& found) const
{
  found.clear ();
  for (const Index cloud_index : cloud_indices_)
    if (cloud_index < point_of_.size () && point_of_[cloud_index] != NONE &&
        point_of_[cloud_index] != p) {
      const Index q = point_of_[cloud_index];
      found.push_back ({(set_.positions[q] - set_.positions[p]).squaredNorm (), q});
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
  search_.nearest (set_.cloud_index[p], static_cast<int> (k + 1), cloud_indices_);
  translate (p, found);
  found.resize (std::min (k, found.size ()));
}

void
CallerSearch::within (Index p, double radius, std::vector<Neighbor>& found)
{
  // Searches of PCL compute in single precision: ask for a little more, then measure.
  constexpr double MORE = 1.0 + 1e-5;
  const double sqr_radius = radius * radius;
  const auto is_outside = [sqr_radius] (const Neighbor& neighbor) {
    return neighbor.sqr_distance > sqr_radius;
  };
  if (search_.within (set_.cloud_index[p], MORE * set_.scale * radius, cloud_indices_))
    translate (p, found);
  else
    for (std::size_t k = 32;; k *= 2) {
      nearest (p, std::min (k, set_.positions.size ()), found);
      if (found.size () < k || is_outside (found.back ()))
        break;
    }
  found.erase (std::find_if (found.begin (), found.end (), is_outside), found.end ());
}

} // namespace floater
} // namespace pcl
