// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/stretch.h"

#include "core/exact.h"
#include "core/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
void
StretchSums::add (const std::array<Eigen::Vector3d, 3>& place,
                  const std::array<Eigen::Vector2d, 3>& uv)
{
  const double area = 0.5 * areaVector (place[0], place[1], place[2]).norm ();
  const Eigen::Vector2d e = uv[1] - uv[0], f = uv[2] - uv[0];
  const double determinant = cross (e, f);
  plane_area_ += 0.5 * determinant;
  if (!(area > 0.0))
    return;
  area_ += area;
  if (!(determinant > 0.0)) {
    squares_ = largest_ = std::numeric_limits<double>::infinity ();
    return;
  }
  // Columns of the Jacobian of the map from the plane.
  const Eigen::Vector3d E = place[1] - place[0], F = place[2] - place[0];
  const Eigen::Vector3d along_u = (E * f.y () - F * e.y ()) / determinant;
  const Eigen::Vector3d along_v = (F * e.x () - E * f.x ()) / determinant;
  const double a = along_u.squaredNorm (), b = along_u.dot (along_v), c = along_v.squaredNorm ();
  squares_ += area * 0.5 * (a + c);
  largest_ = std::max (largest_, std::sqrt (0.5 * (a + c + std::hypot (a - c, 2.0 * b))));
}

double
StretchSums::mean () const
{
  if (std::isinf (squares_)) // also if the area in the plane is negative
    return squares_;
  return area_ > 0.0 ? std::sqrt (squares_ * plane_area_) / area_ : 1.0;
}

double
StretchSums::largest () const
{
  if (std::isinf (largest_))
    return largest_;
  return area_ > 0.0 ? largest_ * std::sqrt (plane_area_ / area_) : 1.0;
}

StretchSums
stretchOf (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& positions,
           const std::vector<Triangle>& corners, const std::vector<Eigen::Vector2d>& uv)
{
  StretchSums sums;
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    const auto& [a, b, c] = triangles[t];
    const auto& [i, j, k] = corners[t];
    sums.add ({positions[a], positions[b], positions[c]}, {uv[i], uv[j], uv[k]});
  }
  return sums;
}

std::vector<Index>
flippedTriangles (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector2d>& uv)
{
  std::vector<Index> flipped;
  for (Index t = 0; t < triangles.size (); ++t)
    if (const auto& [a, b, c] = triangles[t]; !isAntiClockwise (uv[a], uv[b], uv[c]))
      flipped.push_back (t);
  return flipped;
}

} // namespace pcl::floater
