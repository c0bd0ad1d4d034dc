// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay triangulation of the parameters (TW 385, section 2; exact predicates, section 6).
#pragma once

#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// The Delaunay triangulation of points in the plane, by CGAL with exact predicates. Its boundary
/// is the loop. Of coinciding points only one is a vertex, a loop point if there is one. The others,
/// and points on or beyond the loop by rounding, have no triangle. O(n log n).
/// \param uv   per point; non-finite ones are left out
/// \param loop points of a strictly convex polygon around the origin, anti-clockwise
/// \return triangles anti-clockwise in the plane; none if all points lie on one line
TriangleMesh
triangulatePlane (std::vector<Vector2d> uv, const std::vector<Index>& loop);

/// The Delaunay triangulation of points in the plane up to their convex hull. Of coinciding points
/// only one is a vertex. O(n log n).
/// \param uv per point; non-finite ones are left out
/// \return triangles anti-clockwise in the plane; none if all points lie on one line
TriangleMesh
triangulateHull (const std::vector<Vector2d>& uv);

} // namespace pcl::floater
