// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The points that a stage is asked for.
#pragma once

#include "core/types.h"

#include <algorithm>
#include <vector>

namespace pcl
{
namespace floater
{
/// Points to work on, ascending: all, or those that are listed. The list must outlive this.
class Rows
{
public:
  static Rows all (std::size_t points) { return {nullptr, points}; }
  static Rows of (const std::vector<Index>& points) { return {points.data (), points.size ()}; }

  std::size_t size () const { return count_; }
  Index operator[] (std::size_t i) const { return points_ ? points_[i] : static_cast<Index> (i); }

  /// Place of the first one that is not below `point`.
  std::size_t placeOf (Index point) const
  {
    return points_ ? static_cast<std::size_t> (std::lower_bound (points_, points_ + count_, point) -
                                               points_)
                   : std::min<std::size_t> (point, count_);
  }

private:
  Rows (const Index* points, std::size_t count) : points_ (points), count_ (count) {}

  const Index* points_;
  std::size_t count_;
};

} // namespace floater
} // namespace pcl
