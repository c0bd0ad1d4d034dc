// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Exact predicates on points, by CGAL. All coordinates must be finite.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace pcl::floater {
/// Whether three points in the plane are the corners of a triangle, anti-clockwise.
bool
isAntiClockwise (const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Indices of the points on the convex hull, anti-clockwise from the leftmost one. Of equal points,
/// the first is used. O(n log n).
std::vector<std::size_t>
convexHull (const std::vector<Eigen::Vector2d>& points);

/// Whether the edges of a closed polygon meet only at common corners. O(n log n).
bool
isSimplePolygon (const std::vector<Eigen::Vector2d>& corners);

/// Whether three points lie on one line.
bool
areCollinear (const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Whether four points lie in one plane, and there c and d on one side of the line through a and b.
bool
areOnOneSide (const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
              const Eigen::Vector3d& d);

/// Whether two triangles that are not degenerate have a point in common.
bool
doMeet (const std::array<Eigen::Vector3d, 3>& one, const std::array<Eigen::Vector3d, 3>& other);

/// Whether a triangle that is not degenerate and the line segment from a to b have a point in
/// common.
bool
doMeet (const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& a,
        const Eigen::Vector3d& b);

} // namespace pcl::floater
