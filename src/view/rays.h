// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rays from the sensor to the points of a cloud.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

namespace pcl::floater {
/// Depth over width from one ray to the next, from which on one may be beyond the other. Surfaces
/// at less than 14 degrees to the ray return hardly any light: few edges of one are steeper.
constexpr double STEEP = 4.0;

/// Viewpoint of a cloud.
struct Viewpoint
{
  /// Position of the sensor. If it is far away: unit vector along the parallel rays.
  Vector3d place = Vector3d::Zero ();
  bool is_far = false;
  bool is_only_told = false; ///< by the file or outlines; the rays do not tell
};

/// The direction of rays from far beyond a place.
inline Viewpoint
farFrom (const Viewpoint& near, const Vector3d& middle)
{
  return {(middle - near.place).normalized (), true};
}

/// The ray from a viewpoint to a point.
struct Ray
{
  /// Unit vector, zero if the point is the viewpoint; for parallel rays, the projection of the point
  /// on the plane through the origin across them. Their distances are nearly angles, or lengths.
  Vector3d direction;
  double depth; ///< along the ray
};

Ray
rayTo (const Vector3d& position, const Viewpoint& viewpoint);

/// A direction in the widest of the cones without rays, of those around evenly spread directions.
/// \param positions some 2000 of them are looked at
/// \return and the cosine of its angle to the nearest ray
std::pair<Vector3d, double>
emptyDirection (const Positions& positions, const Viewpoint& viewpoint, std::size_t tries);

/// The rays to all points.
struct Rays
{
  std::vector<Vector3d> directions; ///< see Ray
  std::vector<double> depths;       ///< see Ray
  std::vector<double> levels; ///< inverse depths; for parallel rays, depths. On a plane, affine in
                              ///< the place where a ray meets any plane across the rays

  /// Projected rays in the plane: stereographic projection maps circles to circles, so their
  /// Delaunay triangulation is that of the rays. The pole is a direction in the largest cone
  /// without rays. Anti-clockwise triangles face the sensor. NaN for a point that is the viewpoint.
  std::vector<Vector2d> places;
  Viewpoint from;
};

/// O(n).
Rays
makeRays (const Positions& positions, const Viewpoint& viewpoint, const RunContext& run);

} // namespace pcl::floater
