// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_clouds.h"

#include "random_stream.h"
#include "surfaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double TURN = 6.283185307179586;
constexpr std::uint64_t SEED = 1;

Vector3d
uniformPoint (RandomStream& random)
{
  const double x = random.uniform (), y = random.uniform ();
  return {x, y, random.uniform ()};
}

Vector3d
normalPoint (RandomStream& random)
{
  const double x = random.normal (), y = random.normal ();
  return {x, y, random.normal ()};
}

Points
makeSurface (SurfaceKind kind, std::size_t count)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = count;
  return generateSurface (spec);
}

Points
makeOrdinary (std::size_t count)
{
  return makeSurface (SurfaceKind::HEIGHT_FIELD, count);
}

Points
makeNoise (std::size_t count)
{
  RandomStream random (SEED);
  Points points = makeOrdinary (count);
  for (Vector3d& p : points)
    p += normalPoint (random);
  return points;
}

Points
makeBox (std::size_t count)
{
  RandomStream random (SEED);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back (uniformPoint (random));
  return points;
}

Points
makeLattice (std::size_t count)
{
  const auto side = static_cast<std::size_t> (std::cbrt (static_cast<double> (count)));
  Points points;
  for (std::size_t i = 0; i < side * side * side; ++i)
    points.emplace_back (static_cast<double> (i % side), static_cast<double> (i / side % side),
                         static_cast<double> (i / side / side));
  return points;
}

// Smooth curves through a box, sampled evenly; \p jitter is in the distances of their points.
Points
makeCurves (std::size_t count, double jitter)
{
  constexpr std::size_t IN_EACH = 500;
  RandomStream random (SEED);
  Points points;
  while (points.size () < count) {
    constexpr double STEP = 0.002, TURNING = 0.05;
    Vector3d at = uniformPoint (random), direction = normalPoint (random).normalized ();
    for (std::size_t i = 0; i < IN_EACH && points.size () < count; ++i) {
      points.push_back (at + jitter * STEP * normalPoint (random));
      direction = (direction + TURNING * normalPoint (random)).normalized ();
      at += STEP * direction;
    }
  }
  return points;
}

Points
makeWires (std::size_t count)
{
  return makeCurves (count, 0.1);
}

Points
makeCables (std::size_t count)
{
  return makeCurves (count, 1.0);
}

// \p in_each normally distributed points around places in a box, a hundredth as wide as their
// distance.
Points
makeClumps (std::size_t count, std::size_t in_each)
{
  RandomStream random (SEED);
  const double width = 0.01 / std::cbrt (static_cast<double> (count / in_each));
  Points points;
  while (points.size () < count) {
    const Vector3d middle = uniformPoint (random);
    for (std::size_t i = 0; i < in_each && points.size () < count; ++i)
      points.push_back (middle + width * normalPoint (random));
  }
  return points;
}

Points
makeClumpsOf10 (std::size_t count)
{
  return makeClumps (count, 10);
}

Points
makeClumpsOf100 (std::size_t count)
{
  return makeClumps (count, 100);
}

Points
makeClumpsOf1000 (std::size_t count)
{
  return makeClumps (count, 1000);
}

// Groups of points a millionth of a spacing apart, on a height field.
Points
makeGroups (std::size_t count, std::size_t in_each)
{
  constexpr double APART = 1e-6;
  RandomStream random (SEED);
  Points points;
  for (const Vector3d& p : makeOrdinary (count / in_each))
    for (std::size_t i = 0; i < in_each; ++i)
      points.push_back (p + APART * normalPoint (random));
  return points;
}

Points
makePairs (std::size_t count)
{
  return makeGroups (count, 2);
}

Points
makeGroupsOf5 (std::size_t count)
{
  return makeGroups (count, 5);
}

Points
makeGroupsOf50 (std::size_t count)
{
  return makeGroups (count, 50);
}

// Random leaves: small discs that lie anyhow.
Points
makeLeaves (std::size_t count)
{
  constexpr std::size_t IN_EACH = 40;
  RandomStream random (SEED);
  Points points;
  while (points.size () < count) {
    constexpr double WIDTH = 0.02;
    const Vector3d middle = uniformPoint (random), u = normalPoint (random).normalized ();
    const Vector3d v = u.cross (normalPoint (random)).normalized ();
    for (std::size_t i = 0; i < IN_EACH && points.size () < count; ++i) {
      const double r = WIDTH * std::sqrt (random.uniform ()), angle = TURN * random.uniform ();
      points.push_back (middle + r * std::cos (angle) * u + r * std::sin (angle) * v);
    }
  }
  return points;
}

// Two sheets a tenth of a spacing apart.
Points
makeSheets (std::size_t count)
{
  constexpr double GAP = 0.1;
  Points points = makeOrdinary (count / 2);
  SurfaceSpec spec;
  spec.points = count / 2;
  spec.seed = 2;
  for (const Vector3d& p : generateSurface (spec))
    points.push_back (p + GAP * Vector3d::UnitZ ());
  return points;
}

// A ring around one point.
Points
makeHub (std::size_t count)
{
  Points points{Vector3d (0.0, 0.0, 0.1)};
  for (std::size_t i = 1; i < count; ++i) {
    const double angle = TURN * static_cast<double> (i) / static_cast<double> (count - 1);
    points.emplace_back (std::cos (angle), std::sin (angle), 0.0);
  }
  return points;
}

// Two skew lines, whose Delaunay tetrahedra are quadratic in number.
Points
makeSkewLines (std::size_t count)
{
  RandomStream random (SEED);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = random.uniform ();
    points.push_back (i % 2 == 0 ? Vector3d (at, 0.0, 0.0) : Vector3d (0.0, at, 1.0));
  }
  return points;
}

// Points of a random walk.
Points
makeWalk (std::size_t count)
{
  RandomStream random (SEED);
  Points points;
  Vector3d at = Vector3d::Zero ();
  for (std::size_t i = 0; i < count; ++i)
    points.push_back (at += normalPoint (random));
  return points;
}

// A dense half of a sheet beside a sparse one: spacings of 1 to 100.
Points
makeDensityJump (std::size_t count)
{
  constexpr double RATIO = 100.0;
  RandomStream random (SEED);
  const auto rows = static_cast<std::size_t> (std::sqrt (0.5 * static_cast<double> (count)));
  Points points;
  for (std::size_t i = 0; i < rows * rows; ++i) {
    const double x = static_cast<double> (i % rows), y = static_cast<double> (i / rows);
    const Vector3d jitter (0.4 * random.uniform (), 0.4 * random.uniform (), 0.0);
    points.push_back ((Vector3d (x, y, 0.0) + jitter) / RATIO);
    points.push_back (Vector3d (x + 1.0, y, 0.0) + jitter +
                      Vector3d (static_cast<double> (rows) / RATIO, 0.0, 0.0));
  }
  return points;
}

// The density of a sheet grows without end towards a point.
Points
makeCondensation (std::size_t count)
{
  RandomStream random (SEED);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = std::pow (random.uniform (), 5.0), angle = TURN * random.uniform ();
    points.emplace_back (r * std::cos (angle), r * std::sin (angle), 0.1 * r * r);
  }
  return points;
}

Points
makeFarPoint (std::size_t count)
{
  constexpr double FAR = 300.0; // less than what is taken for a gross outlier
  Points points = makeOrdinary (count - 1);
  points.emplace_back (FAR * std::sqrt (static_cast<double> (count)) * Vector3d (1.0, 0.5, 0.2));
  return points;
}

// A narrow band of zigzags, which is filled: its boundary loops have half of all points.
Points
makeBand (std::size_t count)
{
  constexpr std::size_t ROWS = 4;
  const std::size_t around = count / ROWS;
  RandomStream random (SEED);
  Points points;
  for (std::size_t i = 0; i < ROWS * around; ++i) {
    const double angle = TURN * static_cast<double> (i / ROWS) / static_cast<double> (around);
    const double radius = static_cast<double> (around) / TURN + 0.2 * random.uniform ();
    points.emplace_back (radius * std::cos (angle), radius * std::sin (angle),
                         static_cast<double> (i % ROWS) + 0.2 * random.uniform ());
  }
  return points;
}

// A sphere without its upper half, which is filled.
Points
makeBowl (std::size_t count)
{
  return makeSurface (SurfaceKind::HEMISPHERE, count);
}

// Rays at random from the origin, with random depths.
Points
makeRandomView (std::size_t count)
{
  RandomStream random (SEED);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform () - 0.5, y = random.uniform () - 0.5;
    points.push_back ((1.0 + random.uniform ()) * Vector3d (x, y, 1.0));
  }
  return points;
}

// Circles that shrink towards a tip, down to the last bits.
Points
makeSpike (std::size_t count)
{
  constexpr std::size_t ROUND = 50;
  const double shrink = std::pow (1e-12, static_cast<double> (ROUND) / static_cast<double> (count));
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = std::pow (shrink, static_cast<double> (i / ROUND));
    const double angle = TURN * static_cast<double> (i % ROUND) / ROUND;
    points.emplace_back (radius * std::cos (angle), radius * std::sin (angle), -10.0 * radius);
  }
  return points;
}

// Points at a few places, each with many others in the last bits.
Points
makeLastBits (std::size_t count)
{
  constexpr std::size_t PLACES = 100;
  RandomStream random (SEED);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream place (i % PLACES);
    points.push_back (uniformPoint (place) + 1e-15 * normalPoint (random));
  }
  return points;
}

} // namespace

const std::vector<HardCloud>&
hardClouds ()
{
  static const std::vector<HardCloud> all{
      {"ordinary", "a height field", makeOrdinary},
      {"noise", "the same with noise of one spacing", makeNoise},
      {"box", "random points in a box", makeBox},
      {"lattice", "a cubic lattice", makeLattice},
      {"wires", "curves with a jitter of a tenth of their spacing", makeWires},
      {"cables", "curves with a jitter of their spacing", makeCables},
      {"walk", "a random walk", makeWalk},
      {"leaves", "discs of 40 points that lie anyhow", makeLeaves},
      {"clumps of 10", "tight clumps at random places", makeClumpsOf10},
      {"clumps of 100", "the same, larger", makeClumpsOf100},
      {"clumps of 1000", "the same, larger", makeClumpsOf1000},
      {"pairs", "a height field of pairs 1e-6 spacings apart", makePairs},
      {"groups of 5", "the same with groups of 5", makeGroupsOf5},
      {"groups of 50", "the same with groups of 50", makeGroupsOf50},
      {"last bits", "a hundred places, points apart by the last bits", makeLastBits},
      {"sheets", "two sheets a tenth of a spacing apart", makeSheets},
      {"hub", "a ring around one point", makeHub},
      {"skew lines", "two of them", makeSkewLines},
      {"spike", "circles that shrink to the last bits", makeSpike},
      {"density jump", "spacings of 1 and 100 side by side", makeDensityJump},
      {"condensation", "ever denser towards a point", makeCondensation},
      {"far point", "a height field and one point far away", makeFarPoint},
      {"band", "a narrow ring, all holes filled", makeBand, true},
      {"bowl", "half a sphere, all holes filled", makeBowl, true},
      {"random view", "rays with random depths, viewpoint given", makeRandomView, false, true},
  };
  return all;
}

} // namespace floater
} // namespace pcl
