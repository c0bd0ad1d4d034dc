// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/regions.h"

#include "core/disjoint_sets.h"

namespace pcl::floater {
void
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
