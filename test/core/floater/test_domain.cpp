// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/domain.h"

#include "core/geometry.h"
#include "floater/own_shape.h"
#include "random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl::floater {
namespace {
constexpr Domain ALL_DOMAINS[] = {Domain::CIRCLE, Domain::SQUARE, Domain::POLYGON,
                                  Domain::OWN_SHAPE};
constexpr LoopSpacing ALL_SPACINGS[] = {LoopSpacing::CHORD_LENGTH, LoopSpacing::CENTRIPETAL,
                                        LoopSpacing::UNIFORM};
constexpr double LARGEST_BULGE = 2.6e-4; // of a square's side, the largest of all tested here
constexpr int SIDES = 6;

// A loop on a slanted circle, its points at given fractions of a turn.
struct Loop
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<Index> points;

  explicit Loop (const std::vector<double>& turns)
  {
    for (std::size_t i = 0; i < turns.size (); ++i) {
      const double angle = 2.0 * PI * turns[i];
      positions.emplace_back (0.6 * std::cos (angle), 0.8 * std::cos (angle), std::sin (angle));
      points.push_back (static_cast<Index> (i));
    }
  }

  std::size_t size () const { return points.size (); }
  std::vector<Eigen::Vector2d> lay (Domain domain, int sides = SIDES) const
  {
    return layLoop (positions, points, {domain, sides});
  }
  double chord (std::size_t i) const
  {
    return (positions[(i + 1) % size ()] - positions[i]).norm ();
  }
};

Loop
evenLoop (std::size_t count)
{
  std::vector<double> turns (count);
  for (std::size_t i = 0; i < count; ++i)
    turns[i] = static_cast<double> (i) / static_cast<double> (count);
  return Loop (turns);
}

// Step lengths vary by about two orders of magnitude.
Loop
unevenLoop (std::size_t count, std::uint64_t seed)
{
  RandomStream random (seed);
  std::vector<double> turns (count);
  double sum = 0.0;
  for (double& turn : turns) {
    turn = sum;
    sum += std::pow (10.0, -2.0 * random.uniform ());
  }
  for (double& turn : turns)
    turn /= sum;
  return Loop (turns);
}

// Expects a left turn at every point, and one turn in all. Differences of nearly equal doubles are
// exact, so the sign of the cross product is right.
void
expectStrictlyConvex (const std::vector<Eigen::Vector2d>& uv)
{
  const std::size_t count = uv.size ();
  double turn = 0.0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d before = uv[(i + 1) % count] - uv[i];
    const Eigen::Vector2d after = uv[(i + 2) % count] - uv[(i + 1) % count];
    const double sine = cross (before, after);
    wrong += sine > 0.0 ? 0 : 1;
    turn += std::atan2 (sine, before.dot (after));
  }
  EXPECT_EQ (wrong, 0u);
  EXPECT_NEAR (turn, 2.0 * PI, 1e-6);
}

// Distance of a point from the line through two others, positive to the right.
double
rightOf (const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& point)
{
  return cross (point - from, to - from) / (to - from).norm ();
}

TEST (Domain, CircleByChordLength)
{
  const Loop loop = unevenLoop (40, 1);
  const std::vector<Eigen::Vector2d> uv = loop.lay (Domain::CIRCLE);
  ASSERT_EQ (uv.size (), loop.size ());
  double total = 0.0;
  for (std::size_t i = 0; i < loop.size (); ++i)
    total += loop.chord (i);
  EXPECT_EQ (uv[0], Eigen::Vector2d (1.0, 0.0));
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size (); ++i) {
    const double angle = 2.0 * PI * length / total;
    EXPECT_NEAR (uv[i].x (), std::cos (angle), 1e-13);
    EXPECT_NEAR (uv[i].y (), std::sin (angle), 1e-13);
    length += loop.chord (i);
  }
}

TEST (Domain, SquareByChordLength)
{
  const Loop loop = evenLoop (20);
  const std::vector<Eigen::Vector2d> uv = loop.lay (Domain::SQUARE);
  const double half = std::sqrt (0.5);
  const Eigen::Vector2d corners[] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  for (std::size_t i = 0; i < 20; ++i) {
    const Eigen::Vector2d& from = corners[i / 5];
    const Eigen::Vector2d& to = corners[(i / 5 + 1) % 4];
    const Eigen::Vector2d expected = from + static_cast<double> (i % 5) / 5.0 * (to - from);
    EXPECT_LT ((uv[i] - expected).norm (), i % 5 == 0 ? 1e-15 : LARGEST_BULGE) << i;
    EXPECT_GE (rightOf (from, to, uv[i]), -1e-15) << i;
  }
}

TEST (Domain, PolygonCornersAreOnTheUnitCircle)
{
  for (const int sides : {3, 5, 6, 40}) {
    const std::size_t per_side = 4;
    const auto corners = static_cast<std::size_t> (sides);
    const std::vector<Eigen::Vector2d> uv =
        evenLoop (corners * per_side).lay (Domain::POLYGON, sides);
    for (std::size_t c = 0; c < corners; ++c) {
      const Eigen::Vector2d& from = uv[c * per_side];
      const Eigen::Vector2d& to = uv[(c + 1) % corners * per_side];
      EXPECT_NEAR (from.norm (), 1.0, 1e-15);
      EXPECT_NEAR ((to - from).norm (), 2.0 * std::sin (PI / sides), 1e-14);
      const Eigen::Vector2d& middle = uv[c * per_side + per_side / 2];
      const double bulge = rightOf (from, to, middle);
      EXPECT_GT (bulge, 0.0);
      EXPECT_LT (bulge, 2e-3 * (1.0 - std::cos (PI / sides)));
    }
    EXPECT_NEAR (uv[0].y (), uv[per_side].y (), 1e-15) << "the first side is the bottom";
    EXPECT_LT (uv[0].x (), uv[per_side].x ());
  }
}

TEST (Domain, CornersGoToTheNearestLoopPoints)
{
  const Loop loop = unevenLoop (60, 2);
  const std::vector<Eigen::Vector2d> uv = loop.lay (Domain::SQUARE);
  std::vector<double> lengths{0.0};
  for (std::size_t i = 0; i < loop.size (); ++i)
    lengths.push_back (lengths.back () + loop.chord (i));
  for (int corner = 0; corner < 4; ++corner) {
    const double wanted = lengths.back () * corner / 4.0;
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < loop.size (); ++i)
      if (std::abs (lengths[i] - wanted) < std::abs (lengths[nearest] - wanted))
        nearest = i;
    const double angle = -0.75 * PI + 0.5 * PI * corner;
    EXPECT_NEAR (uv[nearest].x (), std::cos (angle), 1e-14) << corner;
    EXPECT_NEAR (uv[nearest].y (), std::sin (angle), 1e-14) << corner;
  }
}

TEST (Domain, EveryCornerHasItsOwnPoint)
{
  // All corners but the first are nearest to the last point, or to the first points.
  const std::vector<double> late{0.0, 0.0001, 0.0002, 0.0003, 0.0004, 0.5};
  const std::vector<double> early{0.0, 0.5, 0.9996, 0.9997, 0.9998, 0.9999};
  for (const auto& turns : {late, early})
    for (const int sides : {3, 4, 5, 6}) {
      const std::vector<Eigen::Vector2d> uv = Loop (turns).lay (Domain::POLYGON, sides);
      EXPECT_EQ (std::count_if (uv.begin (), uv.end (),
                                [] (const auto& p) { return std::abs (p.norm () - 1.0) < 1e-15; }),
                 sides);
      expectStrictlyConvex (uv);
    }
}

TEST (Domain, ShortLoopsGetFewerCorners)
{
  for (const std::size_t count : {3u, 4u, 5u}) {
    const std::vector<Eigen::Vector2d> uv = unevenLoop (count, 3).lay (Domain::POLYGON, 12);
    ASSERT_EQ (uv.size (), count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR (uv[i].norm (), 1.0, 1e-15);
      EXPECT_NEAR ((uv[(i + 1) % count] - uv[i]).norm (),
                   2.0 * std::sin (PI / static_cast<double> (count)), 1e-14);
    }
  }
}

TEST (Domain, LongLoopsAreStrictlyConvex)
{
  for (const Domain domain : ALL_DOMAINS) {
    expectStrictlyConvex (evenLoop (3).lay (domain));
    expectStrictlyConvex (evenLoop (100000).lay (domain));
    expectStrictlyConvex (unevenLoop (100000, 4).lay (domain));
  }
}

TEST (Domain, PointsThatNearlyCoincideGetDistinctParameters)
{
  for (const double gap : {0.0, 1e-16, 1e-14, 1e-12, 1e-9}) {
    std::vector<double> turns (10000); // a hundred groups of a hundred points
    for (std::size_t i = 0; i < turns.size (); ++i) {
      const std::size_t group = i / 100;
      turns[i] = 0.01 * static_cast<double> (group) + gap * static_cast<double> (i % 100);
    }
    const Loop loop (turns);
    for (const Domain domain : ALL_DOMAINS)
      expectStrictlyConvex (loop.lay (domain));
  }
}

TEST (Domain, OneLongStepAmongShortOnesIsStrictlyConvex)
{
  std::vector<double> turns (5000);
  for (std::size_t i = 0; i < turns.size (); ++i)
    turns[i] = 1e-13 * static_cast<double> (i);
  for (const Domain domain : ALL_DOMAINS)
    expectStrictlyConvex (Loop (turns).lay (domain));
}

TEST (Domain, ALoopWithoutLengthIsLaidEvenly)
{
  const std::vector<Eigen::Vector3d> same (8, Eigen::Vector3d::Ones ());
  const std::vector<Index> points{0, 1, 2, 3, 4, 5, 6, 7};
  for (const Domain domain : ALL_DOMAINS)
    expectStrictlyConvex (layLoop (same, points, {domain, SIDES}));
}

// A loop in a slanted plane. It goes from corner to corner in `steps` equal steps.
struct SlantedLoop
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<Index> points;

  SlantedLoop (const std::vector<Eigen::Vector2d>& corners, int steps)
  {
    const Eigen::Vector3d x = Eigen::Vector3d (2.0, 1.0, -1.0).normalized ();
    const Eigen::Vector3d y = Eigen::Vector3d (1.0, -1.0, 1.0).normalized ();
    for (std::size_t c = 0; c < corners.size (); ++c)
      for (int step = 0; step < steps; ++step) {
        const Eigen::Vector2d p = corners[c] + (corners[(c + 1) % corners.size ()] - corners[c]) *
                                                   step / static_cast<double> (steps);
        positions.emplace_back (Eigen::Vector3d (5.0, 6.0, 7.0) + p.x () * x + p.y () * y);
        points.push_back (static_cast<Index> (points.size ()));
      }
  }
  std::vector<Eigen::Vector2d> lay (LoopSpacing spacing = LoopSpacing::CHORD_LENGTH) const
  {
    return layLoop (positions, points, {Domain::OWN_SHAPE, 3, spacing});
  }
};

TEST (Domain, StepsAreByLengthByItsRootOrEqual)
{
  const Loop loop = unevenLoop (50, 6);
  for (const LoopSpacing spacing : ALL_SPACINGS) {
    const auto step = [&] (std::size_t i) {
      return spacing == LoopSpacing::UNIFORM       ? 1.0
             : spacing == LoopSpacing::CENTRIPETAL ? std::sqrt (loop.chord (i))
                                                   : loop.chord (i);
    };
    double total = 0.0;
    for (std::size_t i = 0; i < loop.size (); ++i)
      total += step (i);
    const std::vector<Eigen::Vector2d> uv =
        layLoop (loop.positions, loop.points, {Domain::CIRCLE, SIDES, spacing});
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size (); ++i) {
      const double angle = 2.0 * PI * length / total;
      EXPECT_NEAR (uv[i].x (), std::cos (angle), 1e-13);
      EXPECT_NEAR (uv[i].y (), std::sin (angle), 1e-13);
      length += step (i);
    }
    for (const Domain domain : ALL_DOMAINS)
      expectStrictlyConvex (layLoop (loop.positions, loop.points, {domain, SIDES, spacing}));
  }
}

// All distances keep their proportions, up to the bulge of the sides.
TEST (Domain, OwnShapeOfAConvexLoopIsTheLoop)
{
  const SlantedLoop loop ({{0, 0}, {4, 0}, {5, 2}, {3, 4}, {-1, 3}}, 8);
  const std::vector<Eigen::Vector2d> uv = loop.lay ();
  expectStrictlyConvex (uv);
  double farthest = 0.0;
  for (const Eigen::Vector2d& p : uv)
    farthest = std::max (farthest, p.norm ());
  EXPECT_NEAR (farthest, 1.0, 1e-14);
  const auto distance = [&] (std::size_t i, std::size_t j) {
    return (loop.positions[i] - loop.positions[j]).norm ();
  };
  const double scale = (uv[0] - uv[16]).norm () / distance (0, 16);
  for (std::size_t i = 0; i < uv.size (); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const bool corners = i % 8 == 0 && j % 8 == 0;
      EXPECT_NEAR ((uv[i] - uv[j]).norm (), scale * distance (i, j), corners ? 1e-14 : 1e-3);
    }
}

TEST (Domain, OwnShapeDoesNotDependOnTheFirstPointNorOnTheOrientation)
{
  SlantedLoop loop ({{0, 0}, {4, 0}, {5, 2}, {2, 1.5}, {3, 4}, {-1, 3}}, 5);
  const std::vector<Eigen::Vector2d> uv = loop.lay ();
  std::rotate (loop.points.begin (), loop.points.begin () + 7, loop.points.end ());
  const std::vector<Eigen::Vector2d> turned = loop.lay ();
  std::reverse (loop.points.begin (), loop.points.end ());
  const std::vector<Eigen::Vector2d> reversed = loop.lay ();
  const std::size_t count = uv.size ();
  for (std::size_t i = 0; i < count; ++i)
    for (const std::size_t other : {0, 5, 13}) {
      const double expected = (uv[(i + 7) % count] - uv[(other + 7) % count]).norm ();
      EXPECT_NEAR ((turned[i] - turned[other]).norm (), expected, 1e-12);
      EXPECT_NEAR ((reversed[count - 1 - i] - reversed[count - 1 - other]).norm (), expected,
                   1e-12);
    }
  expectStrictlyConvex (reversed);
}

// Points in a bay of the outline go on the side that closes the bay, spaced as on any side.
TEST (Domain, OwnShapeClosesBays)
{
  const SlantedLoop loop ({{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}}, 4);
  for (const LoopSpacing spacing : ALL_SPACINGS) {
    const std::vector<Eigen::Vector2d> uv = loop.lay (spacing);
    expectStrictlyConvex (uv);
    const Eigen::Vector2d side = uv[16] - uv[8]; // from (4, 3) to (0, 3)
    EXPECT_NEAR (side.norm () / (uv[4] - uv[0]).norm (), 1.0, 1e-13);
    for (std::size_t i = 0; i <= 8; ++i) // eight equal steps
      EXPECT_LT ((uv[8 + i] - uv[8] - side * static_cast<double> (i) / 8.0).norm (), 1e-3);
  }
}

TEST (Domain, ALoopWithoutAShapeIsLaidOnTheCircle)
{
  const SlantedLoop line ({{0, 0}, {1, 0}, {3, 0}}, 5);
  for (const Eigen::Vector2d& p : line.lay ())
    EXPECT_NEAR (p.norm (), 1.0, 1e-14);
  // A figure of eight still has a hull. Whatever comes out is convex.
  const SlantedLoop eight ({{0, 0}, {4, 3}, {4, 0}, {0, 3}}, 10);
  expectStrictlyConvex (eight.lay ());
}

// A box with walls: of two points one above the other the first is the corner. Points on the sides
// are no corners.
TEST (Domain, OwnShapeOfCoincidingAndCollinearPoints)
{
  const std::vector<Eigen::Vector3d> positions{{0, 0, 0}, {0, 0, 1}, {2, 0, 1}, {4, 0, 1},
                                               {4, 0, 0}, {4, 3, 0}, {4, 3, 1}, {2, 3, 1},
                                               {0, 3, 1}, {0, 3, 0}};
  std::vector<Index> loop{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  const SideLimits limits{1e-3, 4e-6};
  EXPECT_EQ (findOwnShape (positions, loop, limits).corners,
             (std::vector<std::size_t>{0, 3, 5, 8}));
  std::rotate (loop.begin (), loop.begin () + 1, loop.end ());
  EXPECT_EQ (findOwnShape (positions, loop, limits).corners,
             (std::vector<std::size_t>{0, 2, 4, 7}));
}

TEST (Domain, OwnShapesOfRoughOutlinesAreStrictlyConvex)
{
  RandomStream random (7);
  for (int round = 0; round < 60; ++round) {
    // Star-shaped outlines, from nearly round to very rough, with up to thousands of points.
    const std::size_t count = 3 + random.below (round % 3 == 0 ? 3000 : 60);
    const double roughness = std::pow (10.0, -8.0 * random.uniform ());
    std::vector<Eigen::Vector2d> corners;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 2.0 * PI * static_cast<double> (i) / static_cast<double> (count);
      const double radius = 1.0 + roughness * (random.uniform () - 0.5);
      corners.emplace_back (3.0 * radius * std::cos (angle), radius * std::sin (angle));
    }
    SCOPED_TRACE (testing::Message () << round << ": " << count << " points, " << roughness);
    for (const LoopSpacing spacing : ALL_SPACINGS)
      expectStrictlyConvex (SlantedLoop (corners, 1 + round % 4).lay (spacing));
  }
}

} // namespace
} // namespace pcl::floater
