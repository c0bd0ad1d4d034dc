// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters of boundary points (TW 385, section 3.2).
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Region growing from the densest unprocessed point; clusters are disjoint, largest first, ties by
/// smallest point; points ascending in each. O(n log n) for points along curves.
/// \param boundary_points ascending
/// \param tolerance growing distance and density radius, in the unit of the positions (xi D)
/// \param k         nearest boundary points appended at each step
std::vector<std::vector<Index>>
clusterBoundaryPoints (const std::vector<Eigen::Vector3d>& positions,
                       const std::vector<Index>& boundary_points, double tolerance, int k);

} // namespace floater
} // namespace pcl
