// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A large cloud in parts, each of which is meshed by itself.
#pragma once

#include "points/point_block.h"

#include <algorithm>

namespace pcl::floater {
/// How a large cloud is cut, and how much of a part others see.
struct PartLimits
{
  /// Points of a part, at most. A smaller cloud is one part, and is meshed as a whole. Of a surface
  /// in parts of m points, about 4.7 sqrt (m) points of each are beside another part: 0.7 % here. A
  /// part takes some 200 MB while it is worked on.
  std::size_t points = std::size_t{1} << 19U;

  /// Width, in rings of points, of the rim that a part passes to the stitching. More are looked at
  /// where that does not suffice. Judging a boundary loop takes 4, and stitching moves boundaries
  /// by 2 at most, but in rare cases.
  std::size_t rings = 6;
};

/// The parts of a cloud: points that follow each other along the space-filling curve. They depend
/// on the number of points only.
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

  /// The points of a part: from the first one to one behind the last.
  Index first (std::size_t part) const { return BlockCutter::firstOf (part, count_, points_); }
  Index last (std::size_t part) const { return first (part + 1); }

  /// The part that has a point.
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
