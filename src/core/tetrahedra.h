// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The Delaunay triangulation of points in space.
#pragma once

#include "core/csr_lists.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace pcl::floater {
/// The tetrahedra of a triangulation. Those outside the convex hull have one corner at infinity,
/// NONE.
struct Tetrahedra
{
  std::vector<std::array<Index, 4>> corners;
  std::vector<std::array<Index, 4>> neighbors; ///< across the facet opposite to each corner
  CsrLists around; ///< of each point: its tetrahedra, infinite ones included, ascending

  std::size_t size () const { return corners.size (); }

  bool isInfinite (Index t) const
  {
    const auto& c = corners[t];
    return c[0] == NONE || c[1] == NONE || c[2] == NONE || c[3] == NONE;
  }

  /// The facet opposite to a corner, anti-clockwise seen from outside the tetrahedron.
  Triangle facet (Index t, unsigned corner) const
  {
    const auto& c = corners[t];
    const Triangle facet{c[(corner + 1) & 3U], c[(corner + 2) & 3U], c[(corner + 3) & 3U]};
    return corner % 2 == 0 ? facet : Triangle{facet[1], facet[0], facet[2]};
  }
};

/// Random points have 7 for each point, those of surfaces up to about 12.
constexpr std::size_t MOST_TETRAHEDRA = 32, FEW_TETRAHEDRA = 10'000;

/// The Delaunay triangulation of distinct points, exact. Where more than four points lie on an
/// empty sphere, one of the possible triangulations. O(n log n) in practice.
/// \return without tetrahedra if all points are in one plane, or if there would be more than
///     MOST_TETRAHEDRA for each point: on a few lines or curves, there are n^2 in all
Tetrahedra
delaunayInSpace (const std::vector<Eigen::Vector3d>& points);

} // namespace pcl::floater
