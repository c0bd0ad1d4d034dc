// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl::floater::fuzz {
namespace {
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double TURN = 6.283185307179586;

double
fraction (std::size_t i, std::size_t n)
{
  return static_cast<double> (i) / static_cast<double> (std::max<std::size_t> (n, 1));
}

Points
makeGrid (std::size_t count, RandomStream& random)
{
  const auto width = 1 + random.below (static_cast<std::size_t> (std::sqrt (count)) + 1);
  const double aspect = random.below (2) == 0 ? 1.0 : std::pow (10.0, 4.0 * random.uniform ());
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / width;
    points.emplace_back (aspect * static_cast<double> (row), static_cast<double> (i % width), 0.0);
  }
  return points;
}

Points
makeLine (std::size_t count, RandomStream& random)
{
  const Vector3d step (random.normal (), random.normal (), random.normal ());
  const double growth = random.below (2) == 0 ? 1.0 : 1.0 + 0.2 * random.uniform ();
  Points points;
  double at = 0.0;
  double length = 1.0;
  for (std::size_t i = 0; i < count; ++i, at += length, length *= growth)
    points.emplace_back (at * step);
  return points;
}

Points
makeCircle (std::size_t count, RandomStream& random)
{
  const std::size_t rings = 1 + random.below (4);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = TURN * fraction (i / rings, count / rings);
    points.emplace_back (std::cos (angle), std::sin (angle), 0.1 * static_cast<double> (i % rings));
  }
  return points;
}

// Points on a sphere: in circles of latitude, or at random. All stars are co-circular in some way.
Points
makeSphere (std::size_t count, RandomStream& random)
{
  const std::size_t round = random.below (2) == 0 ? 0 : 3 + random.below (30);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = round == 0 ? random.uniform () : fraction (i % round, round);
    const double v = round == 0 ? random.uniform ()
                                : fraction (i / round, std::max<std::size_t> (count / round, 1));
    const double z = 2.0 * v - 1.0;
    const double r = std::sqrt (std::max (0.0, 1.0 - z * z));
    points.emplace_back (r * std::cos (TURN * u), r * std::sin (TURN * u), z);
  }
  return points;
}

Points
makeDisc (std::size_t count, RandomStream& random)
{
  const double bend = random.below (2) == 0 ? 0.0 : 3.0 * random.uniform ();
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = std::sqrt (random.uniform ());
    const double angle = TURN * random.uniform ();
    points.emplace_back (r * std::cos (angle), r * std::sin (angle), bend * r * r);
  }
  return points;
}

Points
makeVolume (std::size_t count, RandomStream& random)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back (random.uniform (), random.uniform (), random.uniform ());
  return points;
}

// Few places with many points: equal, or apart by the last bits only.
Points
makeCoincident (std::size_t count, RandomStream& random)
{
  const Points places = makeVolume (1 + random.below (12), random);
  const double apart =
      random.below (2) == 0 ? 0.0 : std::pow (10.0, -17.0 + 6.0 * random.uniform ());
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back (places[random.below (places.size ())] +
                         apart * Vector3d (random.normal (), random.normal (), random.normal ()));
  return points;
}

// A hub with all others around it.
Points
makeHub (std::size_t count, RandomStream& random)
{
  const double height = random.below (2) == 0 ? 0.0 : random.normal ();
  Points points{{0.0, 0.0, height}};
  for (std::size_t i = 1; i < count; ++i) {
    const double angle = TURN * fraction (i - 1, count - 1);
    points.emplace_back (std::cos (angle), std::sin (angle), 0.0);
  }
  return points;
}

// Sheets that touch, cross, or lie closer together than their points.
Points
makeSheets (std::size_t count, RandomStream& random)
{
  const std::size_t sheets = 2 + random.below (3);
  const double gap = random.below (3) == 0 ? 0.0 : std::pow (10.0, -3.0 + 4.0 * random.uniform ());
  const double tilt = random.below (2) == 0 ? 0.0 : random.uniform ();
  const auto width = 1 + static_cast<std::size_t> (std::sqrt (fraction (count, sheets)));
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto sheet = static_cast<double> (i % sheets);
    const auto x = static_cast<double> (i / sheets % width);
    const std::size_t row = i / sheets / width;
    const auto y = static_cast<double> (row);
    points.emplace_back (x, y, sheet * (gap + tilt * x));
  }
  return points;
}

// The faces of a box on a lattice, without its inside.
Points
makeBox (std::size_t count, RandomStream& random)
{
  const auto side = static_cast<std::size_t> (std::sqrt (fraction (count, 6))) + 2;
  const double thin = random.below (2) == 0 ? 1.0 : 0.02;
  Points points;
  for (std::size_t i = 0; i < side * side * side && points.size () < count; ++i) {
    const std::array<std::size_t, 3> at{i % side, i / side % side, i / side / side};
    if (std::any_of (at.begin (), at.end (),
                     [side] (std::size_t c) { return c == 0 || c == side - 1; }))
      points.emplace_back (static_cast<double> (at[0]), static_cast<double> (at[1]),
                           thin * static_cast<double> (at[2]));
  }
  return points;
}

// A spike: circles that become smaller towards a tip, down to the last bits.
Points
makeSpike (std::size_t count, RandomStream& random)
{
  const std::size_t round = 3 + random.below (10);
  const double shrink = 0.3 + 0.65 * random.uniform ();
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t ring = i / round;
    const double radius = std::pow (shrink, static_cast<double> (ring));
    const double angle = TURN * fraction (i % round, round);
    points.emplace_back (radius * std::cos (angle), radius * std::sin (angle),
                         static_cast<double> (ring));
  }
  return points;
}

// A one-sided strip.
Points
makeMoebius (std::size_t count, RandomStream& random)
{
  const std::size_t across = 2 + random.below (6);
  const std::size_t along = std::max<std::size_t> (count / across, 1);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = TURN * fraction (i / across, along);
    const double v = fraction (i % across, across - 1) - 0.5;
    const double r = 1.0 + 0.5 * v * std::cos (0.5 * u);
    points.emplace_back (r * std::cos (u), r * std::sin (u), 0.5 * v * std::sin (0.5 * u));
  }
  return points;
}

// What a depth camera at the origin sees: rays in rows, coarse depths, steps between surfaces.
Points
makeDepthImage (std::size_t count, RandomStream& random)
{
  const auto width = 2 + static_cast<std::size_t> (std::sqrt (count));
  const double step = random.below (2) == 0 ? 1e-4 : 0.05;
  const double edge = random.uniform () - 0.5;
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = fraction (i % width, width) - 0.5;
    const double y = fraction (i / width, width) - 0.5;
    const double depth = (x + 0.3 * y > edge ? 3.0 : 1.0 + 0.2 * x) + 0.01 * random.normal ();
    const double z = std::max (step, step * std::round (depth / step));
    points.emplace_back (x * z, y * z, z);
  }
  return points;
}

} // namespace

std::vector<Vector3d>
makeHardShape (std::size_t kind, std::size_t count, RandomStream& random)
{
  using Maker = Points (*) (std::size_t, RandomStream&);
  static constexpr std::array<Maker, HARD_SHAPES> MAKERS{
      makeGrid, makeDisc,   makeSphere, makeLine,  makeCircle,  makeVolume,    makeCoincident,
      makeHub,  makeSheets, makeBox,    makeSpike, makeMoebius, makeDepthImage};
  return MAKERS.at (kind) (count, random);
}

} // namespace pcl::floater::fuzz
