// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan_samples.h"

#include <limits>

namespace pcl::floater::samples {
namespace {
using Eigen::Vector3d;

// The room is 6 by 6 wide and 3 high.
constexpr double SIDE = 6.0, HEIGHT = 3.0;

struct Hit
{
  double depth = std::numeric_limits<double>::infinity ();
  int object = -1;
};

void
meet (Hit& hit, double depth, int object)
{
  if (depth > 0.0 && depth < hit.depth)
    hit = {depth, object};
}

void
meetBall (Hit& hit, const Vector3d& from, const Vector3d& ray, const Vector3d& middle,
          double radius, int object)
{
  const Vector3d offset = from - middle;
  const double b = offset.dot (ray), root = b * b - offset.squaredNorm () + radius * radius;
  if (root > 0.0)
    meet (hit, -b - std::sqrt (root), object);
}

void
meetPost (Hit& hit, const Vector3d& from, const Vector3d& ray, const Vector3d& foot, double radius,
          int object)
{
  const Eigen::Vector2d offset = (from - foot).head<2> (), flat = ray.head<2> ();
  const double a = flat.squaredNorm (), b = offset.dot (flat);
  const double root = b * b - a * (offset.squaredNorm () - radius * radius);
  if (root > 0.0)
    meet (hit, (-b - std::sqrt (root)) / a, object);
}

Hit
castRay (const Vector3d& from, const Vector3d& ray)
{
  Hit hit;
  meet (hit, -from.z () / ray.z (), 0);
  meet (hit, (SIDE - from.x ()) / ray.x (), 1);
  meet (hit, (SIDE - from.y ()) / ray.y (), 2);
  meetBall (hit, from, ray, {3.5, 3.0, 0.8}, 0.5, 3);
  meetPost (hit, from, ray, {3.0, 4.2, 0.0}, 0.15, 4);
  const Vector3d at = from + hit.depth * ray;
  const bool is_inside = (at.array () > -1e-9).all () && at.x () < SIDE + 1e-9 &&
                         at.y () < SIDE + 1e-9 && at.z () < HEIGHT;
  return is_inside ? hit : Hit{};
}

// Rays of unit length in the frame of the scene; `look` is the direction of a camera.
std::vector<Vector3d>
raysOf (Raster raster, const Vector3d& look)
{
  std::vector<Vector3d> rays;
  const Vector3d right = look.cross (Vector3d::UnitZ ()).normalized (), up = right.cross (look);
  const auto at = [&rays] (double azimuth, double elevation) {
    rays.emplace_back (std::cos (azimuth) * std::cos (elevation),
                       std::sin (azimuth) * std::cos (elevation), std::sin (elevation));
  };
  switch (raster) {
  case Raster::CAMERA:
    for (int i = 0; i < 170; ++i)
      for (int j = 0; j < 120; ++j)
        rays.push_back ((look + 0.006 * ((i - 84.5) * right + (j - 59.5) * up)).normalized ());
    break;
  case Raster::RINGS:
    for (int ring = 0; ring < 40; ++ring)
      for (int i = 0; i < 1800; ++i)
        at (i * 0.2 * DEGREE, (-25.0 + 1.2 * ring) * DEGREE);
    break;
  case Raster::SPHERE:
    for (int ring = 0; ring < 130; ++ring)
      for (int i = 0; i < 360; ++i)
        at (i * DEGREE, (-50.0 + ring) * DEGREE);
    break;
  case Raster::PARALLEL:
  case Raster::LINES:
    break;
  }
  return rays;
}

double
disturbed (double depth, DepthNoise noise, RandomStream& random)
{
  depth *= 1.0 + noise.share * random.normal ();
  return noise.quantum > 0.0 ? 1.0 / (std::round (1.0 / (depth * noise.quantum)) * noise.quantum)
                             : depth;
}

} // namespace

Scan
scanScene (Raster raster, DepthNoise noise, std::uint64_t seed)
{
  RandomStream random (seed);
  Scan scan;
  Vector3d place (0.7 + 0.8 * random.uniform (), 0.7 + 0.8 * random.uniform (),
                  1.2 + 0.6 * random.uniform ());
  const Vector3d look =
      (Vector3d (3.8 + 0.4 * random.uniform (), 3.8 + 0.4 * random.uniform (), 0.6) - place)
          .normalized ();
  if (raster == Raster::PARALLEL || raster == Raster::LINES) {
    const Vector3d right = look.cross (Vector3d::UnitZ ()).normalized (), up = right.cross (look);
    const int between = raster == Raster::LINES ? 5 : 1;
    for (int i = 0; i < 180; ++i)
      for (int j = 0; j < 110; j += between) {
        const Vector3d from = place + 0.02 * ((i - 89.5) * right + (j - 54.5) * up);
        const Hit hit = castRay (from, look);
        if (hit.object < 0)
          continue;
        scan.points.push_back (from + disturbed (hit.depth, noise, random) * look);
        scan.object.push_back (hit.object);
      }
    scan.is_far = true;
  }
  for (const Vector3d& ray : raysOf (raster, look)) {
    const Hit hit = castRay (place, ray);
    if (hit.object < 0)
      continue;
    scan.points.push_back (place + disturbed (hit.depth, noise, random) * ray);
    scan.object.push_back (hit.object);
  }
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond (random.normal (), random.normal (), random.normal (), random.normal ())
          .normalized ();
  const Vector3d shift (10.0 * random.normal (), 10.0 * random.normal (), 10.0 * random.normal ());
  for (Vector3d& point : scan.points)
    point = turn * point + shift;
  scan.viewpoint = scan.is_far ? turn * look : Vector3d (turn * place + shift);
  return scan;
}

Scan
scanYard (DepthNoise noise, std::uint64_t seed)
{
  constexpr double HALF_SIDE = 40.0;
  constexpr int RINGS = 32, RAYS = 1800;
  RandomStream random (seed);
  const auto between = [&random] (double least, double most) {
    return least + (most - least) * random.uniform ();
  };
  const Vector3d slope (between (-0.05, 0.05), between (-0.05, 0.05), 0.0);
  struct Thing
  {
    Vector3d foot;
    double radius;
    bool is_post;
  };
  std::vector<Thing> things;
  for (int i = 0; i < 8; ++i) {
    const double angle = between (0.0, 2.0 * PI), distance = between (5.0, 25.0);
    Vector3d foot (distance * std::cos (angle), distance * std::sin (angle), 0.0);
    foot.z () = slope.dot (foot);
    const bool is_post = i < 4;
    things.push_back ({foot, is_post ? between (0.1, 0.6) : between (1.0, 4.0), is_post});
  }
  Scan scan;
  scan.viewpoint = {between (-2.0, 2.0), between (-2.0, 2.0), between (1.2, 2.6)};
  for (int ring = 0; ring < RINGS; ++ring)
    for (int i = 0; i < RAYS; ++i) {
      const double azimuth = 2.0 * PI * i / RAYS;
      const double elevation = (-25.0 + 35.0 * ring / (RINGS - 1)) * DEGREE;
      const Vector3d ray (std::cos (azimuth) * std::cos (elevation),
                          std::sin (azimuth) * std::cos (elevation), std::sin (elevation));
      Hit hit;
      meet (hit, -(scan.viewpoint.z () - slope.dot (scan.viewpoint)) / (ray.z () - slope.dot (ray)),
            0);
      for (std::size_t k = 0; k < things.size (); ++k) {
        const Thing& thing = things[k];
        const int object = static_cast<int> (k) + 1;
        if (thing.is_post)
          meetPost (hit, scan.viewpoint, ray, thing.foot, thing.radius, object);
        else
          meetBall (hit, scan.viewpoint, ray, thing.foot + thing.radius * Vector3d::UnitZ (),
                    thing.radius, object);
      }
      const Vector3d at = scan.viewpoint + hit.depth * ray;
      if (hit.object < 0 || at.head<2> ().cwiseAbs ().maxCoeff () > HALF_SIDE || at.z () > 8.0)
        continue;
      scan.points.push_back (scan.viewpoint + disturbed (hit.depth, noise, random) * ray);
      scan.object.push_back (hit.object);
    }
  return scan;
}

} // namespace pcl::floater::samples
