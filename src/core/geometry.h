// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Small formulas that several stages share.
#pragma once

#include <Eigen/Geometry>

namespace pcl::floater {
constexpr double PI = 3.14159265358979323846;
constexpr double DEGREE = PI / 180.0; ///< in radians

/// Twice the signed area of the triangle of the origin, a and b; positive if b is to the left of a.
inline double
cross (const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x () * b.y () - a.y () * b.x ();
}

/// Twice the area of a triangle in the direction of its normal.
inline Eigen::Vector3d
areaVector (const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return (b - a).cross (c - a);
}

/// Whether the surface is folded at an edge: the normals of its two triangles are more than 120
/// degrees apart. The normals may have any lengths; a triangle without area is not folded.
inline bool
isFold (const Eigen::Vector3d& normal, const Eigen::Vector3d& other)
{
  constexpr double SQR_COSINE = 0.25; // of 120 degrees
  const double product = normal.dot (other);
  return product < 0.0 &&
         product * product > SQR_COSINE * normal.squaredNorm () * other.squaredNorm ();
}

} // namespace pcl::floater
