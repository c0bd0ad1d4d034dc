// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay triangulation of the parameters (TW 385, section 2; exact predicates, section 6).
#pragma once

#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// The Delaunay triangulation of points in the plane up to their convex hull, by CGAL with exact
/// predicates. Of coinciding points only one is a vertex. O(n log n).
/// \param uv per point; non-finite ones are left out
/// \return triangles anti-clockwise in the plane; none if all points lie on one line
TriangleMesh
triangulateHull (const std::vector<Vector2d>& uv);

/// The same up to the loop. Of coinciding points, a loop point is the vertex if there is one. Points on
/// or beyond the loop by rounding have no triangle.
/// \param loop points of a strictly convex polygon around the origin, anti-clockwise
TriangleMesh
triangulatePlane (std::vector<Vector2d> uv, const std::vector<Index>& loop);

} // namespace pcl::floater
