// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps in stars: sectors in which the surface seems to end.
#pragma once

#include "core/run_context.h"
#include "local/stars.h"

#include <vector>

namespace pcl::floater {
/// A run of consecutive sectors of one star without a triangle, or with too wide a circumcircle.
/// The neighbours at its two ends are the next boundary points from this one.
struct Gap
{
  Index point;
  Index first; ///< neighbour at which the gap begins, anti-clockwise in the point's star
  Index last;  ///< neighbour at which it ends; the same as `first` if only one neighbour is left
};

/// The gaps of all stars, ordered by point. A star without any triangle has one gap, from its
/// nearest neighbour to itself. O(entries).
/// \param stars              with their offsets
/// \param spacing            per point: local spacing, in the unit of the offsets
/// \param circumradius_ratio a triangle counts as missing if its circumradius exceeds this many
///                           times the mean local spacing of its corners
std::vector<Gap>
findGaps (const Stars& stars, const std::vector<float>& spacing, double circumradius_ratio,
          const RunContext& run);

} // namespace pcl::floater
