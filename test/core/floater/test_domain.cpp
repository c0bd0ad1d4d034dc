// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The curve on which the loop is laid, and the connection of all points with the loop.
#include "floater/domain.h"

#include "core/geometry.h"
#include "options/option_rows.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

using Places = std::vector<Eigen::Vector2d>;

constexpr double LARGEST_BULGE = 2.6e-4; // of a square's side
constexpr int SIDES = 6;

struct Loop
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<Index> points;

  void add (const Eigen::Vector3d& position)
  {
    positions.push_back (position);
    points.push_back (static_cast<Index> (points.size ()));
  }
  Places lay (Domain domain, int sides = SIDES,
              LoopSpacing spacing = LoopSpacing::CHORD_LENGTH) const
  {
    return layLoop (positions, points, {domain, sides, spacing});
  }
};

// A loop on a slanted circle, its points at given fractions of a turn.
Loop
roundLoop (const std::vector<double>& turns)
{
  Loop loop;
  for (const double turn : turns) {
    const double angle = 2.0 * PI * turn;
    loop.add ({0.6 * std::cos (angle), 0.8 * std::cos (angle), std::sin (angle)});
  }
  return loop;
}

// A loop in a slanted plane. It goes from corner to corner in `steps` equal steps.
Loop
slantedLoop (const Places& corners, int steps)
{
  const Eigen::Vector3d x = Eigen::Vector3d (2.0, 1.0, -1.0).normalized ();
  const Eigen::Vector3d y = Eigen::Vector3d (1.0, -1.0, 1.0).normalized ();
  Loop loop;
  for (std::size_t c = 0; c < corners.size (); ++c)
    for (int step = 0; step < steps; ++step) {
      const Eigen::Vector2d p = corners[c] + (corners[(c + 1) % corners.size ()] - corners[c]) *
                                                 step / static_cast<double> (steps);
      loop.add (Eigen::Vector3d (5.0, 6.0, 7.0) + p.x () * x + p.y () * y);
    }
  return loop;
}

// Step lengths vary by about so many orders of magnitude.
Loop
unevenLoop (std::size_t count, std::uint64_t seed, double orders = 2.0)
{
  RandomStream random (seed);
  std::vector<double> turns (count);
  double sum = 0.0;
  for (double& turn : turns) {
    turn = sum;
    sum += std::pow (10.0, -orders * random.uniform ());
  }
  for (double& turn : turns)
    turn /= sum;
  return roundLoop (turns);
}

// Expects a left turn at every point, and one turn in all. Differences of nearly equal doubles are
// exact, so the sign of the cross product is right.
void
expectStrictlyConvex (const Places& uv)
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

TEST (Domain, EvenLoopsLieOnRegularPolygons)
{
  for (const int sides : {3, 4, 5, 6, 40}) {
    SCOPED_TRACE (sides);
    const auto corners = static_cast<std::size_t> (sides);
    const Places uv =
        unevenLoop (4 * corners, 1, 0.0).lay (sides == 4 ? Domain::SQUARE : Domain::POLYGON, sides);
    const auto corner = [&] (std::size_t c) -> Eigen::Vector2d { // the first side is the bottom
      const double angle = PI * (2.0 * static_cast<double> (c) - 1.0) / sides - 0.5 * PI;
      return {std::cos (angle), std::sin (angle)};
    };
    const double largest_bulge = sides == 4 ? LARGEST_BULGE : 2e-3 * (1.0 - std::cos (PI / sides));
    for (std::size_t i = 0; i < uv.size (); ++i) {
      const Eigen::Vector2d from = corner (i / 4), to = corner (i / 4 + 1);
      const Eigen::Vector2d expected = from + static_cast<double> (i % 4) / 4.0 * (to - from);
      EXPECT_LT ((uv[i] - expected).norm (), i % 4 == 0 ? 1e-14 : largest_bulge) << i;
      EXPECT_GE (rightOf (from, to, uv[i]), i % 4 == 0 ? -1e-14 : 1e-9) << i;
    }
  }
}

TEST (Domain, EveryCornerHasItsOwnPoint)
{
  // All corners but the first are nearest to the last point, or to the first points.
  const std::vector<double> late{0.0, 0.0001, 0.0002, 0.0003, 0.0004, 0.5};
  const std::vector<double> early{0.0, 0.5, 0.9996, 0.9997, 0.9998, 0.9999};
  for (const auto& turns : {late, early})
    for (const int sides : {3, 4, 5, 6}) {
      const Places laid = roundLoop (turns).lay (Domain::POLYGON, sides);
      EXPECT_EQ (std::count_if (laid.begin (), laid.end (),
                                [] (const auto& p) { return std::abs (p.norm () - 1.0) < 1e-15; }),
                 sides);
      expectStrictlyConvex (laid);
    }
  // A short loop gets fewer corners.
  for (const std::size_t count : {3u, 4u, 5u})
    for (const Eigen::Vector2d& p : unevenLoop (count, 3).lay (Domain::POLYGON, 12))
      EXPECT_NEAR (p.norm (), 1.0, 1e-15);
}

// Long loops, points that coincide or nearly do, a single long step, a line, a figure of eight, and
// rough outlines.
TEST (Domain, EveryLoopIsStrictlyConvex)
{
  std::vector<Loop> loops{unevenLoop (3, 1, 0.0),
                          unevenLoop (100000, 1, 0.0),
                          unevenLoop (100000, 4),
                          roundLoop (std::vector<double> (8, 0.0)),
                          slantedLoop ({{0, 0}, {1, 0}, {3, 0}}, 5),
                          slantedLoop ({{0, 0}, {4, 3}, {4, 0}, {0, 3}}, 10)};
  RandomStream random (7);
  for (int round = 0; round < 60; ++round) {
    const std::size_t count = 3 + random.below (round % 3 == 0 ? 3000 : 60);
    const double roughness = std::pow (10.0, -8.0 * random.uniform ());
    Places corners;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 2.0 * PI * static_cast<double> (i) / static_cast<double> (count);
      const double radius = 1.0 + roughness * (random.uniform () - 0.5);
      corners.emplace_back (3.0 * radius * std::cos (angle), radius * std::sin (angle));
    }
    loops.push_back (slantedLoop (corners, 1 + round % 4));
  }
  for (const double gap : {0.0, 1e-16, 1e-14, 1e-12, 1e-9}) {
    std::vector<double> turns (10000); // a hundred groups of a hundred points
    for (std::size_t i = 0; i < turns.size (); ++i)
      turns[i] = 0.01 * static_cast<double> (i / 100) + gap * static_cast<double> (i % 100);
    loops.push_back (roundLoop (turns));
  }
  std::vector<double> short_steps (5000);
  for (std::size_t i = 0; i < short_steps.size (); ++i)
    short_steps[i] = 1e-13 * static_cast<double> (i);
  loops.push_back (roundLoop (short_steps));
  for (const Loop& loop : loops)
    for (const auto& [name, domain] : DOMAIN_CHOICES)
      expectStrictlyConvex (loop.lay (domain));
}

TEST (Domain, StepsAreByLengthByItsRootOrEqual)
{
  constexpr std::size_t COUNT = 50;
  const Loop loop = unevenLoop (COUNT, 6);
  for (const auto& [spacing_name, spacing] : SPACING_CHOICES) {
    const auto step = [&] (std::size_t i) {
      const double chord = (loop.positions[(i + 1) % COUNT] - loop.positions[i]).norm ();
      return spacing == LoopSpacing::UNIFORM       ? 1.0
             : spacing == LoopSpacing::CENTRIPETAL ? std::sqrt (chord)
                                                   : chord;
    };
    double total = 0.0;
    for (std::size_t i = 0; i < COUNT; ++i)
      total += step (i);
    const Places uv = loop.lay (Domain::CIRCLE, SIDES, spacing);
    EXPECT_EQ (uv[0], Eigen::Vector2d (1.0, 0.0));
    double length = 0.0;
    for (std::size_t i = 0; i < COUNT; ++i) {
      const double angle = 2.0 * PI * length / total;
      EXPECT_NEAR (uv[i].x (), std::cos (angle), 1e-13);
      EXPECT_NEAR (uv[i].y (), std::sin (angle), 1e-13);
      length += step (i);
    }
    for (const auto& [name, domain] : DOMAIN_CHOICES)
      expectStrictlyConvex (loop.lay (domain, SIDES, spacing));
  }
}

// The definition instead of the algorithm: follows the rows until nothing changes.
std::vector<std::uint8_t>
reachableByDefinition (const CsrLists& rows, const std::vector<Index>& loop)
{
  std::vector<std::uint8_t> reachable (rows.rows (), 0);
  for (const Index p : loop)
    reachable[p] = 1;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t p = 0; p < rows.rows (); ++p)
      for (const Index q : rows.row (p))
        if (reachable[p] == 0 && reachable[q] != 0) {
          reachable[p] = 1;
          changed = true;
        }
  }
  return reachable;
}

TEST (Reachability, MatchesItsDefinitionOnRandomGraphs)
{
  RandomStream random (2);
  for (std::uint32_t round = 0; round < 50; ++round) {
    const std::size_t count = 5 + random.below (60);
    CsrLists rows{{0}, {}};
    while (rows.rows () < count) {
      for (std::size_t i = random.below (2 + round % 2); i > 0; --i)
        rows.ids.push_back (static_cast<Index> (random.below (count)));
      rows.offsets.push_back (static_cast<Index> (rows.ids.size ()));
    }
    EXPECT_EQ (reachLoop (rows, {0, 1}, 1), reachableByDefinition (rows, {0, 1}));
  }
}

} // namespace
} // namespace pcl::floater
