// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Regions of a cloud: points of a kind that hang together.
#pragma once

#include "core/csr_lists.h"
#include "core/disjoint_sets.h"

#include <cstdint>
#include <vector>

namespace pcl::floater {
/// Points of which those that hang together are judged together.
struct RegionPoints
{
  std::vector<std::uint8_t> is_inside;  ///< of each point: whether it may be in a region
  std::vector<std::uint8_t> is_counted; ///< whether it counts for its region
  std::vector<float> value;             ///< of the points that count
};

/// Takes the regions with at least so many points that count, and at least this mean of their
/// values. Points hang together if one is among the nearest 20 of the other. O(n).
/// \param neighbors of each point, nearest first
/// \param taken     set to 1 at all points of such regions; otherwise left as it is
inline void
takeRegions (const CsrLists& neighbors, const RegionPoints& points, std::size_t least,
             double least_mean, std::vector<std::uint8_t>& taken)
{
  constexpr std::size_t NEAREST = 20;
  const std::size_t n = points.is_inside.size ();
  DisjointSets regions (n);
  for (Index p = 0; p < n; ++p)
    if (points.is_inside[p] != 0)
      for (const Index q : neighbors.first (p, NEAREST))
        if (points.is_inside[q] != 0)
          regions.join (p, q);
  std::vector<std::size_t> count (n, 0);
  std::vector<double> sum (n, 0.0);
  for (Index p = 0; p < n; ++p)
    if (points.is_inside[p] != 0 && points.is_counted[p] != 0) {
      const Index region = regions.find (p);
      ++count[region];
      sum[region] += static_cast<double> (points.value[p]);
    }
  for (Index p = 0; p < n; ++p) {
    const Index region = regions.find (p);
    if (points.is_inside[p] != 0 && count[region] >= least &&
        sum[region] >= least_mean * static_cast<double> (count[region]))
      taken[p] = 1;
  }
}

} // namespace pcl::floater
