// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/rays.h"

#include "core/geometry.h"
#include "core/parallel.h"

namespace pcl::floater {
std::pair<Vector3d, double>
emptyDirection (const Positions& positions, const Viewpoint& viewpoint, std::size_t tries)
{
  constexpr std::size_t COMPARED = 2000;
  const std::size_t step = std::max<std::size_t> (1, positions.size () / COMPARED);
  std::vector<Vector3d> directions;
  for (std::size_t p = 0; p < positions.size (); p += step)
    directions.push_back (rayTo (positions[p], viewpoint).direction);
  Vector3d best = Vector3d::UnitZ ();
  double cosine = std::numeric_limits<double>::infinity (); // of the angle to the nearest ray
  // In an order without neighbours in a row, of which each may be a little better than the one before.
  constexpr std::size_t STRIDE = 1237;
  for (std::size_t k = 0; k < tries; ++k) {
    const Vector3d tried = spiralDirection (k * STRIDE % tries, tries);
    double nearest = -1.0;
    for (std::size_t i = 0; i < directions.size () && nearest < cosine; ++i)
      nearest = std::max (nearest, tried.dot (directions[i]));
    if (nearest < cosine) {
      cosine = nearest;
      best = tried;
    }
  }
  return {best, cosine};
}

Ray
rayTo (const Vector3d& position, const Viewpoint& viewpoint)
{
  if (viewpoint.is_far) {
    const double depth = position.dot (viewpoint.place);
    return {position - depth * viewpoint.place, depth};
  }
  const Vector3d offset = position - viewpoint.place;
  const double depth = offset.norm ();
  return {depth > 0.0 ? Vector3d (offset / depth) : Vector3d (Vector3d::Zero ()), depth};
}

Rays
makeRays (const Positions& positions, const Viewpoint& viewpoint, const RunContext& run)
{
  const std::size_t n = positions.size ();
  Rays rays;
  rays.from = viewpoint;
  rays.directions.resize (n);
  rays.depths.resize (n);
  rays.levels.resize (n);
  rays.places.resize (n);
  // Seen from the sensor, x to y is anti-clockwise: the frame is right-handed about a vector
  // towards the sensor. Stereographic projection from `pole` looks at the sphere from outside.
  constexpr std::size_t TRIES = 2000; // finds cones of 5 degrees: the tear of the plane is small
  const Vector3d pole = viewpoint.is_far ? Vector3d (-viewpoint.place)
                                         : emptyDirection (positions, viewpoint, TRIES).first;
  const Vector3d x = pole.unitOrthogonal (), y = pole.cross (x);
  parallelPoints (run, n, [&] (Index p) {
    const auto [direction, depth] = rayTo (positions[p], viewpoint);
    rays.directions[p] = direction;
    rays.depths[p] = depth;
    rays.levels[p] = viewpoint.is_far ? depth : 1.0 / depth;
    const double factor = viewpoint.is_far ? 1.0
                          : depth > 0.0    ? 1.0 / (1.0 - direction.dot (pole))
                                           : std::numeric_limits<double>::quiet_NaN ();
    rays.places[p] = factor * Vector2d (direction.dot (x), direction.dot (y));
  });
  return rays;
}

} // namespace pcl::floater
