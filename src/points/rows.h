// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Subsets of the points.
#pragma once

#include "core/types.h"

#include <algorithm>
#include <vector>

namespace pcl::floater {
/// Points to work on, ascending: all, a range, or a list. The list must outlive this.
class Rows
{
public:
  static Rows all (std::size_t points) { return {nullptr, 0, points}; }
  static Rows range (Index first, Index last) { return {nullptr, first, last - first}; }
  static Rows of (const std::vector<Index>& points) { return {points.data (), 0, points.size ()}; }

  std::size_t size () const { return count_; }
  Index operator[] (std::size_t i) const
  {
    return points_ ? points_[i] : first_ + static_cast<Index> (i);
  }

  /// Index of the first one that is not below `point`.
  std::size_t placeOf (Index point) const
  {
    return points_ ? static_cast<std::size_t> (std::lower_bound (points_, points_ + count_, point) -
                                               points_)
                   : std::min<std::size_t> (std::max (point, first_) - first_, count_);
  }

private:
  Rows (const Index* points, Index first, std::size_t count)
      : points_ (points), first_ (first), count_ (count)
  {
  }

  const Index* points_;
  Index first_; // if none are listed
  std::size_t count_;
};

} // namespace pcl::floater
