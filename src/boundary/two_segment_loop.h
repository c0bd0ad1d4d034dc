// SPDX-License-Identifier: GPL-3.0-or-later
// The report's ordering of a boundary cluster (TW 385, section 3.3).
#pragma once

#include "common/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Splits a cluster in two connected segments that share their ends, orders each by the univariate
/// Floater parameterization between its ends (reciprocal distance weights), and joins them to a
/// loop. The seed is the first point of the cluster (the report takes a random one).
/// Weakness: where the cluster is a thick band, or the border turns back on itself within the
/// neighbourhood, the order along it is not that of the border.
/// \return every point of the cluster once, in order; empty if it has fewer than 4 points or a
///         segment's system is singular
std::vector<Index>
twoSegmentLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& cluster);

} // namespace floater
} // namespace pcl
