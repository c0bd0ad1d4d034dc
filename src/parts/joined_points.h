// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points of several lists in one order.
#pragma once

#include "core/order_statistics.h"
#include "core/types.h"

#include <algorithm>
#include <vector>

namespace pcl
{
namespace floater
{
/// Numbers for some points of a cloud, in the order of the cloud.
class JoinedPoints
{
public:
  /// Adds points; those that are there already count once.
  void add (const std::vector<Index>& points)
  {
    points_.insert (points_.end (), points.begin (), points.end ());
  }

  /// To be called when all points have been added.
  void sort () { sortUnique (points_); }

  std::size_t size () const { return points_.size (); }

  Index pointAt (Index place) const { return points_[place]; }

  /// NONE if the point is not there. O(log n).
  Index placeOf (Index point) const
  {
    const auto at = std::lower_bound (points_.begin (), points_.end (), point);
    return at != points_.end () && *at == point ? static_cast<Index> (at - points_.begin ()) : NONE;
  }

private:
  std::vector<Index> points_;
};

} // namespace floater
} // namespace pcl
