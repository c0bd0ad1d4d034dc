// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons of a file as triangles.
#pragma once

#include "cloud.h"
#include "plural.h"

namespace pcl::floater {
/// Cuts polygons into triangles at their first corners.
class PolygonFans
{
public:
  /// \param points of which the corners must be
  PolygonFans (std::size_t points, Triangles& triangles) : points_ (points), triangles_ (triangles)
  {
  }

  /// Begins a polygon.
  void begin () { corners_ = 0; }

  /// \throws ReadError if there is no such point
  void add (double corner)
  {
    if (!(corner >= 0.0 && corner < static_cast<double> (points_)))
      throw ReadError ("a polygon has a corner that is none of the " + counted (points_, "point"));
    const auto point = static_cast<std::uint32_t> (corner);
    if (corners_ == 0)
      first_ = point;
    else if (corners_ > 1)
      triangles_.push_back ({first_, last_, point});
    last_ = point;
    ++corners_;
  }

private:
  std::size_t points_;
  Triangles& triangles_;
  std::size_t corners_ = 0; // of the polygon so far
  std::uint32_t first_ = 0, last_ = 0;
};

} // namespace pcl::floater
