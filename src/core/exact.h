// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Exact predicates on points, and the Delaunay triangulation of points in space, by CGAL. All coordinates must be
// finite.
#pragma once

#include "core/csr_lists.h"

namespace pcl::floater {
/// Whether three points in the plane are the corners of a triangle, anti-clockwise.
bool
isAntiClockwise (const Vector2d& a, const Vector2d& b, const Vector2d& c);

/// The corners of the convex hull, anti-clockwise from the leftmost one. O(n log n).
std::vector<Vector2d>
convexHull (const std::vector<Vector2d>& points);

/// Whether the edges of a closed polygon meet only at common corners. O(n log n).
bool
isSimplePolygon (const std::vector<Vector2d>& corners);

/// Whether three points lie on one line.
bool
areCollinear (const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// Whether four points lie in one plane, and there c and d on one side of the line through a and b.
bool
areOnOneSide (const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d);

/// Whether two triangles that are not degenerate have a point in common.
bool
doMeet (const std::array<Vector3d, 3>& one, const std::array<Vector3d, 3>& other);

/// Whether a triangle that is not degenerate and the line segment from a to b have a point in
/// common.
bool
doMeet (const std::array<Vector3d, 3>& triangle, const Vector3d& a, const Vector3d& b);

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
delaunayInSpace (const Positions& points);

} // namespace pcl::floater
