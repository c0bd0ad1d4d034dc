// SPDX-License-Identifier: GPL-3.0-or-later
// The points that the stages work on.
#pragma once

#include "common/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Drops non-finite positions, merges exact duplicates (the smallest cloud index stands for all),
/// centres, scales to a bounding box diagonal of 1, and sorts along a Hilbert curve. O(n log n).
/// \param positions   any
/// \param cloud_index of each position; distinct
/// \param threads     0 for all cores
WorkingSet
makeWorkingSet (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& cloud_index,
                int threads);

} // namespace floater
} // namespace pcl
