// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facing_cases.h"

#include "core/geometry.h"
#include "level_sets.h"
#include "random_directions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace pcl::floater::facing_cases {
namespace {
FacingCase
asCase (Soup soup)
{
  FacingCase one;
  one.mesh = meshOf (soup);
  one.positions = std::move (soup.positions);
  return one;
}

constexpr int CAP_SIDE = 30;

Field
randomBlob (RandomStream& random, int most_parts)
{
  std::vector<Field> parts{
      ellipsoid (Vector::Zero (), {between (random, 0.4, 0.7), between (random, 0.4, 0.7),
                                   between (random, 0.4, 0.7)})};
  for (auto i = random.below (static_cast<std::size_t> (most_parts) + 1); i > 0; --i)
    parts.push_back (ellipsoid (
        0.5 * randomDirection (random),
        {between (random, 0.15, 0.4), between (random, 0.15, 0.4), between (random, 0.15, 0.4)}));
  return unite (std::move (parts));
}

Field
randomWingedBody (RandomStream& random)
{
  const double size = between (random, 0.15, 0.6);
  std::vector<Field> parts{ellipsoid (Vector::Zero (), {between (random, 0.7, 1.0) * size,
                                                        between (random, 0.7, 1.0) * size, size})};
  for (auto i = random.below (5); i > 0; --i) {
    const Eigen::Matrix3d axes = randomRotation (random);
    parts.push_back (slab (between (random, 0.1, 0.5) * axes.col (0),
                           {between (random, 0.2, 0.5), between (random, 0.15, 0.5), 0.07}, axes));
  }
  for (auto i = random.below (3); i > 0; --i)
    parts.push_back (ring (0.6 * randomDirection (random), between (random, 0.2, 0.35), 0.08,
                           randomRotation (random)));
  return unite (std::move (parts));
}

// Flattened along one axis, which makes all parts thinner.
Eigen::Matrix3d
flattening (RandomStream& random, double least)
{
  const Eigen::Matrix3d axes = randomRotation (random);
  const Vector scale (1.0, between (random, 0.6, 1.0), between (random, least, 1.0));
  return axes * scale.asDiagonal () * axes.transpose ();
}

using Height = std::function<double (double, double)>;

// Heights on the unit square, of a root mean square slope up to 45 degrees.
Height
randomHeights (RandomStream& random)
{
  struct Wave
  {
    double x, y, phase, height;
  };
  std::vector<Wave> waves;
  const double roughness = between (random, 0.5, 1.5);
  for (int i = 0; i < 12; ++i) {
    const double frequency = std::pow (2.0, between (random, 0.0, 3.5));
    const double angle = between (random, 0.0, 2.0 * PI);
    waves.push_back ({2.0 * PI * frequency * std::cos (angle),
                      2.0 * PI * frequency * std::sin (angle), between (random, 0.0, 2.0 * PI),
                      std::pow (frequency, -roughness)});
  }
  double sqr_slope = 0.0;
  for (const Wave& w : waves)
    sqr_slope += 0.5 * w.height * w.height * (w.x * w.x + w.y * w.y);
  const double scale =
      std::tan (between (random, 0.0, 45.0) * DEGREE) / std::max (1e-9, std::sqrt (sqr_slope));
  const bool has_steps = random.below (4) == 0;
  // A pit or hill with a flat floor, of slopes up to 45 degrees.
  const double floor = between (random, 0.0, 0.3), rim = between (random, floor + 0.05, 0.5);
  const double depth = random.below (2) == 0
                           ? std::tan (between (random, -45.0, 45.0) * DEGREE) * (rim - floor)
                           : 0.0;
  return [=] (double x, double y) {
    double z = 0.0;
    for (const Wave& w : waves)
      z += scale * w.height * std::sin (w.x * x + w.y * y + w.phase);
    if (has_steps) {
      const double step = 0.05, rest = z / step - std::floor (z / step);
      z = step * (std::floor (z / step) + std::min (1.0, 3.0 * rest));
    }
    const double r = std::hypot (x - 0.5, y - 0.5);
    return (depth != 0.0 ? 0.3 * z : z) + depth * std::clamp ((rim - r) / (rim - floor), 0.0, 1.0);
  };
}

Soup
heightField (const Height& height, double aspect, int side)
{
  return grid ([&] (double u, double v) { return Vector (u, aspect * v, height (u, aspect * v)); },
               side, std::max (4, static_cast<int> (aspect * side)), false);
}

// A cap around -z, its concave side up; the front is outside.
Soup
cap (double share, int side)
{
  const double end = std::acos (1.0 - 2.0 * share);
  return grid (
      [end] (double u, double v) {
        const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0;
        const Eigen::Vector2d disc (y * std::sqrt (1.0 - 0.5 * x * x),
                                    x * std::sqrt (1.0 - 0.5 * y * y));
        const double angle = end * disc.norm ();
        const Eigen::Vector2d around = disc.norm () > 0.0 ? disc.normalized () : disc;
        return Vector (around.x () * std::sin (angle), around.y () * std::sin (angle),
                       -std::cos (angle));
      },
      side, side, false);
}

FacingCase
wingedBody (RandomStream& random)
{
  Soup soup = levelSet (randomWingedBody (random));
  dropSmall (soup, 0);
  transform (soup, flattening (random, 0.3));
  const int windows = 1 + static_cast<int> (random.below (10));
  cutWindows (soup, windows, between (random, 0.01, windows == 1 ? 0.3 : 0.5), random);
  transform (soup, randomRotation (random));
  return asCase (std::move (soup));
}

FacingCase
hollowShell (RandomStream& random)
{
  const Field body = randomBlob (random, 2);
  Soup outer = levelSet (body);
  const double thickness = between (random, 0.02, 0.15);
  Soup inner = levelSet ([&] (const Vector& p) { return body (p) + thickness; });
  dropSmall (outer, 0);
  dropSmall (inner, 0);
  const int windows = static_cast<int> (random.below (6));
  if (windows > 0)
    cutCones ({&outer, &inner}, windows, random);
  turnRound (inner);
  append (outer, inner);
  transform (outer, randomRotation (random));
  return asCase (std::move (outer));
}

FacingCase
bodyInShell (RandomStream& random)
{
  Soup outer = levelSet (randomBlob (random, 2));
  Soup inner = levelSet (randomBlob (random, 0)); // radii differ by at most 0.4 / 0.7
  transform (inner, between (random, 0.2, 0.5) * randomRotation (random));
  dropSmall (outer, 0);
  cutCones ({&outer}, 1 + static_cast<int> (random.below (5)), random);
  append (outer, inner);
  transform (outer, randomRotation (random));
  return asCase (std::move (outer));
}

FacingCase
nestedBodies (RandomStream& random)
{
  Soup all;
  double size = 1.0;
  const auto depth = 2 + random.below (3);
  for (std::size_t i = 0; i < depth; ++i) {
    Soup soup = levelSet (randomBlob (random, 0));
    if (i % 2 == 1)
      turnRound (soup);
    transform (soup, size * randomRotation (random));
    append (all, soup);
    size *= between (random, 0.3, 0.55); // radii differ by at most 0.4 / 0.7
  }
  Soup beside = levelSet (randomBlob (random, 2));
  dropSmall (beside, 0);
  for (Vector& p : beside.positions)
    p += 3.0 * Vector::UnitX ();
  append (all, beside);
  transform (all, randomRotation (random));
  return asCase (std::move (all));
}

FacingCase
tube (RandomStream& random)
{
  const double length = std::exp (between (random, std::log (0.2), std::log (10.0)));
  const double cone = between (random, -0.3, 0.3) * std::min (length, 1.0),
               bend = between (random, 0.0, 0.3);
  Soup soup = grid (
      [=] (double u, double v) {
        const double radius = 1.0 + cone * (v - 0.5);
        return Vector (radius * std::cos (2.0 * PI * u) + bend * length * v * v,
                       radius * std::sin (2.0 * PI * u), length * v);
      },
      40, std::max (3, static_cast<int> (6.0 * length)), true);
  transform (soup, randomRotation (random));
  return asCase (std::move (soup));
}

FacingCase
torus (RandomStream& random)
{
  Soup soup = levelSet (
      ring (Vector::Zero (), 0.8, between (random, 0.12, 0.4), Eigen::Matrix3d::Identity ()));
  const int windows = 1 + static_cast<int> (random.below (10));
  cutWindows (soup, windows, between (random, 0.01, windows == 1 ? 0.3 : 0.5), random);
  transform (soup, randomRotation (random));
  return asCase (std::move (soup));
}

FacingCase
randomCap (double low, double high, bool is_sheet, RandomStream& random)
{
  const double share = between (random, low, high);
  Soup soup = cap (share, CAP_SIDE);
  if (!is_sheet)
    transform (soup, randomRotation (random));
  else {
    if (random.below (2) == 0)
      turnRound (soup); // a valley; its front is up
    else
      transform (soup, Eigen::AngleAxisd (PI, Vector::UnitX ()).toRotationMatrix ());
    transform (soup, randomTilt (random, 30.0));
  }
  FacingCase one = asCase (std::move (soup));
  one.parameter = share;
  return one;
}

FacingCase
terrain (RandomStream& random)
{
  Soup soup = heightField (randomHeights (random), between (random, 0.2, 1.0), 70);
  if (random.below (2) == 0)
    cutWindows (soup, 1 + static_cast<int> (random.below (5)), between (random, 0.01, 0.3), random);
  transform (soup, randomTilt (random, 20.0));
  return asCase (std::move (soup));
}

FacingCase
halfStatue (RandomStream& random)
{
  Soup soup = levelSet (randomBlob (random, 4));
  keepSeen (soup, randomDirection (random));
  return asCase (std::move (soup));
}

FacingCase
cutStatue (RandomStream& random)
{
  Soup soup = levelSet (randomWingedBody (random));
  dropSmall (soup, 0);
  const Vector down = randomDirection (random);
  double low = 0.0;
  for (const Vector& p : soup.positions)
    low = std::min (low, p.dot (down));
  cutBelow (soup, down, between (random, 0.2, 0.95) * low);
  return asCase (std::move (soup));
}

FacingCase
tornSheet (RandomStream& random)
{
  Soup soup;
  if (random.below (2) == 0)
    soup = heightField (randomHeights (random), between (random, 0.4, 1.0), 60);
  else {
    // A sheet in tall folds, each side of which is nearly upright.
    const double height = between (random, 0.05, 0.4), folds = between (random, 1.0, 3.0);
    soup = heightField (
        [=] (double x, double y) {
          return height * std::sin (2.0 * PI * folds * x) + 0.02 * std::sin (9.0 * y);
        },
        1.0, 60);
  }
  tear (soup, 1 + static_cast<int> (random.below (4)), between (random, 0.01, 0.06), random);
  transform (soup, randomTilt (random, 10.0));
  return asCase (std::move (soup));
}

FacingCase
tornBody (RandomStream& random)
{
  Soup soup = levelSet (randomBlob (random, 3));
  dropSmall (soup, 0);
  tear (soup, 1 + static_cast<int> (random.below (4)), between (random, 0.02, 0.2), random);
  transform (soup, randomRotation (random));
  return asCase (std::move (soup));
}

// A surface of which all is seen from the sensor, from any side.
FacingCase
scanWithSensor (RandomStream& random)
{
  Soup soup;
  Vector sensor;
  switch (random.below (3)) {
  case 0: { // a sheet, seen from above or below
    soup = heightField ([] (double x, double y) { return 0.05 * std::sin (9.0 * x) * y; }, 1.0, 50);
    const bool is_above = random.below (2) == 0;
    sensor = {0.5, 0.5, is_above ? 2.0 : -2.0};
    if (!is_above)
      turnRound (soup);
    break;
  }
  case 1: // a room or bowl, seen from inside
    soup = cap (between (random, 0.1, 0.95), CAP_SIDE);
    turnRound (soup);
    sensor = 0.2 * randomDirection (random) - 0.5 * Vector::UnitZ ();
    break;
  default: // a statue, seen from outside
    soup = levelSet (randomBlob (random, 4));
    sensor = 10.0 * randomDirection (random);
    keepSeen (soup, sensor.normalized ());
  }
  const Eigen::Matrix3d rotation = randomRotation (random);
  transform (soup, rotation);
  FacingCase one = asCase (std::move (soup));
  one.hints.sensor = rotation * sensor;
  return one;
}

} // namespace

const char*
familyName (Family family)
{
  static constexpr std::array<const char*, static_cast<std::size_t> (Family::COUNT)> NAMES{
      "winged body",        "hollow shell", "nested bodies", "body in shell",   "tube",
      "torus with windows", "deep cap",     "shallow cap",   "terrain",         "half statue",
      "cut statue",         "torn sheet",   "torn body",     "scan with sensor"};
  return NAMES[static_cast<std::size_t> (family)];
}

FacingCase
makeFacingCase (Family family, std::uint64_t seed)
{
  RandomStream random (seed * static_cast<std::uint64_t> (Family::COUNT) +
                       static_cast<std::uint64_t> (family) + 1);
  switch (family) {
  case Family::WINGED_BODY:
    return wingedBody (random);
  case Family::HOLLOW_SHELL:
    return hollowShell (random);
  case Family::NESTED_BODIES:
    return nestedBodies (random);
  case Family::BODY_IN_SHELL:
    return bodyInShell (random);
  case Family::TUBE:
    return tube (random);
  case Family::TORUS:
    return torus (random);
  case Family::DEEP_CAP:
    return randomCap (0.3, 0.98, false, random);
  case Family::SHALLOW_CAP:
    return randomCap (0.01, 0.2, true, random);
  case Family::TERRAIN:
    return terrain (random);
  case Family::HALF_STATUE:
    return halfStatue (random);
  case Family::CUT_STATUE:
    return cutStatue (random);
  case Family::TORN_SHEET:
    return tornSheet (random);
  case Family::TORN_BODY:
    return tornBody (random);
  default:
    return scanWithSensor (random);
  }
}

FacingCase
makeBowl (double share_of_area, int side)
{
  return asCase (cap (share_of_area, side));
}

TriangleMesh
turnAtRandom (const FacingCase& one, RandomStream& random)
{
  const MeshComponents components = findComponents (one.mesh, 1);
  std::vector<std::uint8_t> is_turned;
  for (Index c = 0; c < components.count; ++c)
    is_turned.push_back (static_cast<std::uint8_t> (random.below (2)));
  TriangleMesh mesh = one.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t)
    if (is_turned[components.of_triangle[t]] != 0)
      std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
  mesh.connect (one.positions.size (), 1);
  return mesh;
}

double
wrongShare (const FacingCase& one, const TriangleMesh& mesh)
{
  double wrong = 0.0, all = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
    const auto& [a, b, c] = one.mesh.triangles[t];
    const double area = areaVector (one.positions[a], one.positions[b], one.positions[c]).norm ();
    all += area;
    if (mesh.triangles[t] != one.mesh.triangles[t])
      wrong += area;
  }
  return all > 0.0 ? wrong / all : 0.0;
}

} // namespace pcl::floater::facing_cases
