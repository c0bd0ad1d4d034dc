// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps in stars: sectors where the surface seems to end.
#pragma once

#include "local/stars.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// A run of sectors of one star that have no triangle or one with a wide empty circle. The two
/// neighbours at its ends are the next boundary points as seen from this one.
struct Gap
{
  Index point;
  Index first; ///< neighbour where the gap begins, anti-clockwise in the point's star
  Index last;  ///< neighbour where it ends; equal to `first` if only one neighbour is joined
};

/// Gaps of all stars, ordered by point. A triangle counts as missing if its circumradius exceeds
/// `alpha` times the mean spacing of its corners. A star without any triangle gives a gap from its
/// nearest neighbour to itself. O(entries).
std::vector<Gap>
findGaps (const Stars& stars, const std::vector<float>& spacing, double alpha);

} // namespace floater
} // namespace pcl
