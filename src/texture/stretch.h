// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stretch of a texture, and what rounding to floats has flipped.
#pragma once

#include "core/types.h"

#include <array>
#include <vector>

namespace pcl::floater {
/// Sums over triangles for the stretch. The map goes from the plane to the surface, as in texture
/// mapping: where it enlarges, the texture is coarse.
class StretchSums
{
public:
  /// Adds a triangle in space and in the plane; ignored if it has no area in space.
  void add (const std::array<Eigen::Vector3d, 3>& place, const std::array<Eigen::Vector2d, 3>& uv);

  double planeArea () const { return plane_area_; }

  /// L2 stretch: root mean square over the surface of the singular values of the map, times the
  /// root of the ratio of the areas. 1 if all lengths have the same ratio, or without triangles;
  /// otherwise more; infinite if a triangle with an area in space has none in the plane.
  double mean () const;

  /// L2 stretch without the root of the ratio; 1 without triangles.
  double absolute () const { return area_ > 0.0 ? std::sqrt (squares_ / area_) : 1.0; }

  /// L-infinity stretch: largest singular value of any triangle, times the same root.
  double largest () const;

private:
  double squares_ = 0.0; // integral of the mean square of the two singular values
  double area_ = 0.0, plane_area_ = 0.0;
  double largest_ = 0.0; // singular value
};

/// Sums over a mesh.
/// \param corners of its triangles as indices of uv, parallel to triangles
StretchSums
stretchOf (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& positions,
           const std::vector<Triangle>& corners, const std::vector<Eigen::Vector2d>& uv);

/// The triangles that are not anti-clockwise in the plane, ascending. Exact.
/// \param triangles corners as indices of uv
std::vector<Index>
flippedTriangles (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector2d>& uv);

} // namespace pcl::floater
