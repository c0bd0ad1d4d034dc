// SPDX-License-Identifier: GPL-3.0-or-later
// The report's ordering of a boundary cluster (TW 385, section 3.3).
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Splits a cluster in two connected segments that share their ends, orders each by the univariate
/// Floater parameterization between its ends (reciprocal distance weights), and joins them to a
/// loop. The seed is the first point of the cluster (the report takes a random one). Where the
/// report leaves a choice: a segment grows nearest to its start first; its neighbourhoods are
/// symmetric, those of the parameterization hold 3, 4 or 5 points, whichever gives the shorter way;
/// gaps wider than any neighbourhood are bridged where they are narrowest. O(n log n).
/// Weakness: where the cluster is a thick band, or the border turns back on itself within the
/// neighbourhood, the order along it is not that of the border.
/// \return every point of the cluster once, in order; empty if it has fewer than 4 points, two of
///         them coincide, or a segment's system is singular
std::vector<Index>
twoSegmentLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& cluster);

} // namespace floater
} // namespace pcl
