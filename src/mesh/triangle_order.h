// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Spatial order of triangles.
#pragma once

#include "core/csr_lists.h"

#include <algorithm>
#include <vector>

namespace pcl::floater {
/// Triangles by their smallest points, which lie along a space-filling curve; stable. O(n).
/// \param points number of points; corners are below
inline std::vector<Index>
orderByPoints (const std::vector<Triangle>& triangles, std::size_t points)
{
  return makeCsrLists (points,
                       [&] (const auto& emit) {
                         for (Index t = 0; t < triangles.size (); ++t) {
                           const Triangle& corners = triangles[t];
                           emit (*std::min_element (corners.begin (), corners.end ()), t);
                         }
                       })
      .ids;
}

} // namespace pcl::floater
