// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Division of a large cloud into parts, which are meshed separately.
#pragma once

#include "points/point_block.h"

#include <algorithm>

namespace pcl::floater {
/// Size of the parts, and of the rims that they share.
struct PartLimits
{
  /// Maximum points of a part. A smaller cloud is one part, and is meshed as a whole. In a surface
  /// in parts of m points, about 4.7 sqrt (m) points of each are beside another part: 0.7 % here.
  /// Processing a part takes some 200 MB.
  std::size_t points = std::size_t{1} << 19U;

  /// Width, in rings of points, of the rim that a part passes to the stitching; increased if it
  /// does not suffice. Judging a boundary loop takes 4, and stitching rarely moves boundaries by
  /// more than 2.
  std::size_t rings = 6;
};

/// The parts of a cloud: consecutive points on the space-filling curve. They depend only on the
/// number of points.
class Parts
{
public:
  Parts (std::size_t points, const PartLimits& limits)
      : points_ (points),
        count_ (std::max<std::size_t> (1, (points + limits.points - 1) / limits.points))
  {
  }

  std::size_t points () const { return points_; }
  std::size_t count () const { return count_; }

  /// First point of a part, and one past its last.
  Index first (std::size_t part) const { return BlockCutter::firstOf (part, count_, points_); }
  Index last (std::size_t part) const { return first (part + 1); }

  /// The part of a point.
  std::size_t partOf (Index point) const
  {
    std::size_t low = 0, high = count_;
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (first (middle) <= point ? low : high) = middle;
    }
    return low;
  }

private:
  std::size_t points_, count_;
};

} // namespace pcl::floater
