// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/caller_search.h"

#include <algorithm>

namespace pcl::floater {
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

} // namespace pcl::floater
