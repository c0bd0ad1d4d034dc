// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How much a layout in the plane stretches a surface (Sander, Snyder, Gortler, Hoppe 2001).
#pragma once

#include "core/types.h"

#include <algorithm>
#include <array>

namespace pcl::floater {
/// Sums over triangles, from which the stretch follows. The map goes from the plane to the surface,
/// as textures do: where it is wide, a texture is coarse.
class StretchSums
{
public:
  /// A triangle in space and in the plane; it does not count if it has no area in space.
  void add (const std::array<Eigen::Vector3d, 3>& place, const std::array<Eigen::Vector2d, 3>& uv);

  void add (const StretchSums& other);

  double area () const { return area_; }            ///< in space
  double planeArea () const { return plane_area_; } ///< in the plane

  /// Mean over the surface of the mean square of the two singular values of the map.
  double meanSquare () const { return area_ > 0.0 ? squares_ / area_ : 0.0; }

  /// Root mean square over the surface of the singular values of the map, times the root of the
  /// ratio of the areas: 1 if lengths are in one ratio everywhere, else more; 1 without triangles;
  /// infinite if a triangle with an area in space has none in the plane. Also called the L2
  /// stretch.
  double mean () const;

  /// Largest singular value of any triangle, times the same root: the L-infinity stretch.
  double largest () const;

private:
  double squares_ = 0.0; // integral of the mean square of the two singular values
  double area_ = 0.0, plane_area_ = 0.0;
  double largest_ = 0.0; // singular value
};

} // namespace pcl::floater
