// SPDX-License-Identifier: GPL-3.0-or-later
// The points that the stages work on.
#pragma once

#include "common/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Drops non-finite positions, centres, scales to a bounding box diagonal of 1, merges duplicates
/// (the smallest cloud index stands for all), and sorts along a Hilbert curve. O(n log n). Points
/// are duplicates if they are equal after scaling: those nearer to each other than 1e-16 of the
/// diagonal may be, and no later stage could tell them apart.
/// \param positions   any
/// \param cloud_index of each position; distinct
/// \param threads     0 for all cores
WorkingSet
makeWorkingSet (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Index>& cloud_index, int threads);

} // namespace floater
} // namespace pcl
