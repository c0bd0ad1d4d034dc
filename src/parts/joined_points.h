// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A subset of the points of a cloud, renumbered.
#pragma once

#include "core/types.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pcl::floater {
/// Numbers some points of a cloud, in the order of the cloud.
class JoinedPoints
{
public:
  JoinedPoints () = default;

  /// \param points ascending, each once
  explicit JoinedPoints (std::vector<Index> points) : points_ (std::move (points)) {}

  std::size_t size () const { return points_.size (); }

  Index pointAt (Index place) const { return points_[place]; }

  /// Index of a point, NONE if it is not included. O(log n).
  Index placeOf (Index point) const
  {
    const auto at = std::lower_bound (points_.begin (), points_.end (), point);
    return at != points_.end () && *at == point ? static_cast<Index> (at - points_.begin ()) : NONE;
  }

private:
  std::vector<Index> points_;
};

} // namespace pcl::floater
