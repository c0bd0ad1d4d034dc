// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scans of two scenes: a room with a ball and a thin post before its walls, and a yard.
#pragma once

#include "samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater::samples {
/// How a sensor spaces its rays.
enum class Raster
{
  CAMERA, ///< pixels of a plane
  RINGS,  ///< cones around the upright, 6 times as far apart as the rays in each
  SPHERE, ///< all angles alike, all around but the lowest 40 degrees
  LINES   ///< parallel rays along lines, 5 times as far apart as the rays in each
};

struct Scan
{
  Positions points;
  std::vector<int> object;   ///< of each point: which surface was hit
  Eigen::Vector3d viewpoint; ///< of parallel rays, their direction
  bool is_far = false;
};

/// How depths are disturbed.
struct DepthNoise
{
  double share = 0.0;   ///< standard deviation, in depths
  double quantum = 0.0; ///< step of the inverse depth, as of a camera with two lenses
};

struct ScanRay
{
  Eigen::Vector3d from, along; ///< of unit length
};

struct Plane
{
  Eigen::Vector3d normal;
  double offset;
};

struct Thing
{
  Eigen::Vector3d place; ///< middle of a ball, foot of an upright post
  double radius;         ///< negative: its inside is seen
  bool is_post;
};

/// Planes, and things on them, which are the objects in this order. What is outside of the box is
/// not there.
struct Scene
{
  std::vector<Plane> planes;
  std::vector<Thing> things;
  Eigen::AlignedBox3d box;
};

inline double
depthOf (const Plane& plane, const ScanRay& ray)
{
  return (plane.offset - plane.normal.dot (ray.from)) / plane.normal.dot (ray.along);
}

inline double
depthOf (const Thing& thing, const ScanRay& ray)
{
  Eigen::Vector3d offset = ray.from - thing.place, along = ray.along;
  if (thing.is_post)
    offset.z () = along.z () = 0.0;
  const double a = along.squaredNorm (), b = offset.dot (along);
  const double root = b * b - a * (offset.squaredNorm () - thing.radius * thing.radius);
  return root > 0.0 ? (-b - std::copysign (std::sqrt (root), thing.radius)) / a : -1.0;
}

/// What the rays meet first, as seen from where the first one begins.
inline Scan
castRays (const Scene& scene, const std::vector<ScanRay>& rays, DepthNoise noise,
          RandomStream& random)
{
  Scan scan;
  scan.viewpoint = rays.front ().from;
  for (const ScanRay& ray : rays) {
    double nearest = std::numeric_limits<double>::infinity ();
    int object = 0, hit = -1;
    const auto meet = [&] (const auto& surface) {
      const double depth = depthOf (surface, ray);
      if (depth > 0.0 && depth < nearest) {
        nearest = depth;
        hit = object;
      }
      ++object;
    };
    std::for_each (scene.planes.begin (), scene.planes.end (), meet);
    std::for_each (scene.things.begin (), scene.things.end (), meet);
    if (hit < 0 || !scene.box.contains (ray.from + nearest * ray.along))
      continue;
    double depth = nearest * (1.0 + noise.share * random.normal ());
    if (noise.quantum > 0.0)
      depth = 1.0 / (std::round (1.0 / (depth * noise.quantum)) * noise.quantum);
    scan.points.push_back (ray.from + depth * ray.along);
    scan.object.push_back (hit);
  }
  return scan;
}

/// Rays on cones around the upright. The lowest elevation and the step between cones, in degrees.
inline std::vector<ScanRay>
raysInRings (const Eigen::Vector3d& from, int rings, int in_ring, double lowest, double step)
{
  std::vector<ScanRay> rays;
  for (int ring = 0; ring < rings; ++ring)
    for (int i = 0; i < in_ring; ++i) {
      const double azimuth = 2.0 * PI * i / in_ring, elevation = (lowest + step * ring) * DEGREE;
      rays.push_back ({from, polar (std::cos (elevation), azimuth, std::sin (elevation))});
    }
  return rays;
}

/// \param look direction of a camera
inline std::vector<ScanRay>
raysOf (Raster raster, const Eigen::Vector3d& place, const Eigen::Vector3d& look)
{
  if (raster == Raster::RINGS)
    return raysInRings (place, 40, 1800, -25.0, 1.2);
  if (raster == Raster::SPHERE)
    return raysInRings (place, 130, 360, -50.0, 1.0);
  const Eigen::Vector3d right = look.cross (Eigen::Vector3d::UnitZ ()).normalized ();
  const Eigen::Vector3d up = right.cross (look);
  std::vector<ScanRay> rays;
  if (raster == Raster::CAMERA)
    for (int i = 0; i < 170; ++i)
      for (int j = 0; j < 120; ++j)
        rays.push_back (
            {place, (look + 0.006 * ((i - 84.5) * right + (j - 59.5) * up)).normalized ()});
  else
    for (int i = 0; i < 180; ++i)
      for (int j = 0; j < 110; j += 5)
        rays.push_back ({place + 0.02 * ((i - 89.5) * right + (j - 54.5) * up), look});
  return rays;
}

/// A scan of the room, from a place and in a direction that hang on the seed. About 20,000 rays.
/// The frame is turned and moved at random, too.
inline Scan
scanScene (Raster raster, DepthNoise noise, std::uint64_t seed)
{
  using Eigen::Vector3d;
  constexpr double SIDE = 6.0, HEIGHT = 3.0, ROUNDING = 1e-9;
  const Scene room{
      {{Vector3d::UnitZ (), 0.0}, {Vector3d::UnitX (), SIDE}, {Vector3d::UnitY (), SIDE}},
      {{{3.5, 3.0, 0.8}, 0.5, false}, {{3.0, 4.2, 0.0}, 0.15, true}},
      {Vector3d::Constant (-ROUNDING), Vector3d (SIDE + ROUNDING, SIDE + ROUNDING, HEIGHT)}};
  RandomStream random (seed);
  const Vector3d place (0.7 + 0.8 * random.uniform (), 0.7 + 0.8 * random.uniform (),
                        1.2 + 0.6 * random.uniform ());
  const Vector3d target (3.8 + 0.4 * random.uniform (), 3.8 + 0.4 * random.uniform (), 0.6);
  const Vector3d look = (target - place).normalized ();
  Scan scan = castRays (room, raysOf (raster, place, look), noise, random);
  scan.is_far = raster == Raster::LINES;
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond (random.normal (), random.normal (), random.normal (), random.normal ())
          .normalized ();
  const Vector3d shift (10.0 * random.normal (), 10.0 * random.normal (), 10.0 * random.normal ());
  for (Vector3d& point : scan.points)
    point = turn * point + shift;
  scan.viewpoint = scan.is_far ? turn * look : Vector3d (turn * place + shift);
  return scan;
}

/// Ground, walls and things around a sensor 1.6 above the ground, at the origin.
inline Scene
courtyard ()
{
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX (), y = Eigen::Vector3d::UnitY ();
  return {{{Eigen::Vector3d::UnitZ (), -1.6}, {x, 14.0}, {-x, 9.0}, {y, 8.0}, {-y, 6.0}},
          {{{6.0, 2.0, 0.2}, 1.1, false},
           {{4.0, -3.0, -1.6}, 0.2, true},
           {{-4.0, 3.0, -1.6}, 0.4, true},
           {{-5.0, -3.0, -0.6}, 1.0, false}},
          {Eigen::Vector3d (-9.1, -6.1, -2.0), Eigen::Vector3d (14.1, 8.1, 4.0)}};
}

/// A scan of a yard of `width` by `width`: sloping ground, and around the sensor posts, and balls that rest on
/// it. The sensor stands 1.2 to 2.6 above the ground, up to `off` from the middle.
inline Scan
scanYard (double width, double off, bool is_dense, std::uint64_t seed)
{
  RandomStream random (seed);
  const Eigen::Vector3d slope{between (random, -0.05, 0.05), between (random, -0.05, 0.05), 0.0};
  const Eigen::Vector3d corner (0.5 * width, 0.5 * width, 8.0);
  Scene yard{{{Eigen::Vector3d::UnitZ () - slope, 0.0}}, {}, {-corner, corner}};
  Eigen::Vector3d place{between (random, -off, off), between (random, -off, off), 0.0};
  place.z () = slope.dot (place) + between (random, 1.2, 2.6);
  for (int i = 0; i < 8; ++i) {
    const double angle = between (random, 0.0, 2.0 * PI), distance = between (random, 5.0, 25.0);
    Eigen::Vector3d foot = place + polar (distance, angle);
    const bool is_post = i < 4;
    const double radius = is_post ? between (random, 0.1, 0.6) : between (random, 1.0, 4.0);
    foot.z () = slope.dot (foot) + (is_post ? 0.0 : radius);
    yard.things.push_back ({foot, radius, is_post});
  }
  return castRays (yard,
                   is_dense ? raysInRings (place, 200, 720, -60.0, 0.5)
                            : raysInRings (place, 32, 1800, -25.0, 35.0 / 31.0),
                   {is_dense ? 0.0001 : 0.0005, 0.0}, random);
}

using Direction = std::function<Eigen::Vector3d (const Eigen::Vector3d&)>;

/// Share of the triangles that face there.
inline double
shareFacing (const Result& result, const Positions& positions, const Direction& there)
{
  std::size_t facing = 0;
  for (const auto& t : result.triangles) {
    const Eigen::Vector3d &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
    facing += areaVector (a, b, c).dot (there ((a + b + c) / 3.0)) > 0.0 ? 1 : 0;
  }
  return static_cast<double> (facing) / static_cast<double> (result.triangles.size ());
}

/// A view from a place that is given.
inline Options
seenFrom (const Eigen::Vector3d& viewpoint)
{
  Options options;
  options.view.use = ViewUse::GIVEN;
  options.view.viewpoint = {viewpoint.x (), viewpoint.y (), viewpoint.z ()};
  return options;
}

/// The mesh of a scan as its sensor saw it, which faces the sensor.
inline Result
viewOf (const Scan& scan, const Options& options)
{
  Result result = meshOf (scan.points, options);
  EXPECT_TRUE (result.report.is_view);
  EXPECT_EQ (result.report.is_far_view, scan.is_far);
  if (options.view.use == ViewUse::GIVEN) {
    const Direction there = [&scan] (const Eigen::Vector3d& p) { return scan.viewpoint - p; };
    EXPECT_EQ (shareFacing (result, scan.points, there), 1.0);
  }
  return result;
}

} // namespace pcl::floater::samples
