// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "darts.h"
#include "surface_samples.h"
#include "surfaces.h"

namespace pcl::floater::samples {
namespace {
double
lengthOf (const Outline& outline)
{
  double length = 0.0;
  for (std::size_t i = 0; i < outline.size (); ++i)
    length += (outline[(i + 1) % outline.size ()] - outline[i]).norm ();
  return length;
}

KnownSurface
generated (SurfaceKind kind, std::size_t points, double slenderness, std::uint64_t seed)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  spec.length = slenderness;
  spec.seed = seed;
  KnownSurface made;
  made.points = generateSurface (spec);
  made.loops = static_cast<std::size_t> (boundaryLoops (spec));
  made.handles =
      static_cast<std::size_t> (2 - boundaryLoops (spec) - eulerCharacteristic (spec)) / 2;
  made.area = static_cast<double> (points);
  return made;
}

// Walls over an outline, a floor and perhaps a lid. The upper and lower edges of the walls have
// points of their own, and so have upright edges.
KnownSurface
prism (const Outline& corners, const Outline& loop, const Outline& uprights, double height,
       bool with_lid, std::uint64_t seed)
{
  const double walls = lengthOf (corners) * height, floor = areaOf (corners);
  KnownSurface made;
  made.loops = with_lid ? 0 : 1;
  made.area = walls + (with_lid ? 2.0 : 1.0) * floor;
  std::vector<Dart> edges;
  for (const Eigen::Vector2d& p : loop)
    for (const double z : {0.0, height})
      edges.push_back ({{p.x (), p.y (), z}});
  for (const Eigen::Vector2d& p : uprights)
    for (double z = 1.0; z < height - 0.5; z += 1.0)
      edges.push_back ({{p.x (), p.y (), z}});

  const auto onWall = [&] (double along, double z) -> Dart {
    std::size_t side = 0;
    Eigen::Vector2d step = corners[1] - corners[0];
    while (along > step.norm () && side + 1 < corners.size ()) {
      along -= step.norm ();
      ++side;
      step = corners[(side + 1) % corners.size ()] - corners[side];
    }
    const Eigen::Vector2d p = corners[side] + std::min (along / step.norm (), 1.0) * step;
    return {{p.x (), p.y (), z}};
  };
  RandomStream random (seed);
  made.points = throwDarts (
      std::move (edges), made.area,
      [&] (RandomStream& stream) -> Dart {
        const double part = stream.uniform () * made.area;
        if (part < walls)
          return onWall (part / height, height * stream.uniform ());
        const Eigen::Vector2d p = randomInside ({corners}, stream);
        return {{p.x (), p.y (), part < walls + floor ? 0.0 : height}};
      },
      random);
  return made;
}

KnownSurface
sharpPrism (const Outline& corners, double height, bool with_lid, std::uint64_t seed)
{
  return prism (corners, resample (corners, 1.0), corners, height, with_lid, seed);
}

} // namespace

KnownSurface
finger (double slenderness, std::size_t points, std::uint64_t seed)
{
  return generated (SurfaceKind::FINGER, points, slenderness, seed);
}

KnownSurface
sphere (std::size_t points, std::uint64_t seed)
{
  return generated (SurfaceKind::SPHERE, points, 0.0, seed);
}

KnownSurface
sphereWithThreeHoles (std::uint64_t seed)
{
  constexpr double RADIUS = 14.0, HOLE = 5.0;
  const double height = std::sqrt (RADIUS * RADIUS - HOLE * HOLE);
  std::vector<Dart> loops;
  for (const Eigen::Vector2d& p : circle (HOLE, 1.0)) {
    loops.push_back ({{p.x (), p.y (), height}});
    loops.push_back ({{p.y (), height, p.x ()}});
    loops.push_back ({{-height, p.x (), p.y ()}});
  }
  KnownSurface made;
  made.loops = 3;
  made.area = 2.0 * PI * RADIUS * (2.0 * RADIUS - 3.0 * (RADIUS - height));
  RandomStream random (seed);
  made.points = throwDarts (
      std::move (loops), made.area,
      [=] (RandomStream& stream) -> Dart {
        Eigen::Vector3d p;
        do {
          p.x () = stream.normal ();
          p.y () = stream.normal ();
          p.z () = stream.normal ();
          p *= RADIUS / p.norm ();
        } while (p.z () > height || p.y () > height || p.x () < -height);
        return {p};
      },
      random);
  return made;
}

KnownSurface
torus (std::size_t points, std::uint64_t seed)
{
  return generated (SurfaceKind::TORUS, points, 0.0, seed);
}

// (x^2 (1 - x^2) - y^2)^2 + z^2 = c^2: the points near a figure of eight.
KnownSurface
doubleTorus (std::uint64_t seed)
{
  constexpr double SIZE = 26.0, THICKNESS = 0.14;
  const auto value = [] (const Eigen::Vector3d& p, Eigen::Vector3d& gradient) {
    const double flat = p.x () * p.x () * (1.0 - p.x () * p.x ()) - p.y () * p.y ();
    gradient = {2.0 * flat * (2.0 * p.x () - 4.0 * p.x () * p.x () * p.x ()), -4.0 * flat * p.y (),
                2.0 * p.z ()};
    return flat * flat + p.z () * p.z () - THICKNESS * THICKNESS;
  };
  constexpr double AREA = 6.5; // about, of SIZE 1
  KnownSurface made;
  made.handles = 2;
  RandomStream random (seed);
  made.points = throwDarts (
      {}, AREA * SIZE * SIZE,
      [&] (RandomStream& stream) -> Dart {
        for (;;) {
          Eigen::Vector3d p, gradient;
          p.x () = 2.4 * (stream.uniform () - 0.5);
          p.y () = 1.4 * (stream.uniform () - 0.5);
          p.z () = 2.4 * THICKNESS * (stream.uniform () - 0.5);
          double f = value (p, gradient);
          for (int newton = 0; newton < 8 && std::abs (f) > 1e-12; ++newton) {
            p -= f / gradient.squaredNorm () * gradient;
            f = value (p, gradient);
          }
          if (std::abs (f) <= 1e-12 && p.cwiseAbs ().maxCoeff () < 1.5)
            return {SIZE * p};
        }
      },
      random);
  return made;
}

KnownSurface
moebiusStrip (std::uint64_t seed)
{
  constexpr double RADIUS = 30.0, HALF_WIDTH = 6.0;
  const auto at = [] (double angle, double across) {
    const double r = RADIUS + across * std::cos (0.5 * angle);
    return Eigen::Vector3d (r * std::cos (angle), r * std::sin (angle),
                            across * std::sin (0.5 * angle));
  };
  std::vector<Dart> border;
  const int count = static_cast<int> (4.0 * PI * RADIUS);
  for (int i = 0; i < count; ++i)
    border.push_back ({at (4.0 * PI * i / count, HALF_WIDTH)});
  KnownSurface made;
  made.loops = 1;
  RandomStream random (seed);
  made.points = throwDarts (
      std::move (border), 4.0 * PI * RADIUS * HALF_WIDTH,
      [&] (RandomStream& stream) -> Dart {
        const double angle = 2.0 * PI * stream.uniform ();
        return {at (angle, HALF_WIDTH * (2.0 * stream.uniform () - 1.0))};
      },
      random);
  return made;
}

KnownSurface
box (bool with_lid, std::uint64_t seed)
{
  return sharpPrism (rectangle (25.0, 18.0), 15.0, with_lid, seed);
}

KnownSurface
bracket (std::uint64_t seed)
{
  return sharpPrism ({{0, 0}, {30, 0}, {30, 6}, {6, 6}, {6, 24}, {0, 24}}, 15.0, true, seed);
}

KnownSurface
cylinder (std::uint64_t seed)
{
  constexpr double RADIUS = 10.0;
  const Outline fine = circle (RADIUS, 0.1);
  Outline loop;
  for (std::size_t i = 0; i < fine.size (); i += 10)
    loop.push_back (fine[i]);
  return prism (fine, loop, {}, 24.0, true, seed);
}

KnownSurface
wedge (std::uint64_t seed)
{
  constexpr double SIDE = 32.0, HEIGHT = 20.0;
  KnownSurface made =
      sharpPrism ({{0, 0}, {SIDE, 0}, {SIDE * std::cos (PI / 6.0), SIDE * std::sin (PI / 6.0)}},
                  HEIGHT, true, seed);
  made.sharp_length = HEIGHT;
  return made;
}

} // namespace pcl::floater::samples
