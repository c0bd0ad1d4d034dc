// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Regions of a cloud: points of a kind that hang together.
#pragma once

#include "core/csr_lists.h"

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
void
takeRegions (const CsrLists& neighbors, const RegionPoints& points, std::size_t least,
             double least_mean, std::vector<std::uint8_t>& taken);

} // namespace pcl::floater
