// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary stage (TW 385, section 3): clusters of boundary points, both finders of loops; and the curve on which
// the loop is laid.
#include "floater/boundary/boundary.h"

#include "core/geometry.h"
#include "floater/floater_method.h"
#include "options/option_rows.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;
using Clusters = std::vector<std::vector<Index>>;

// Points of a line, with gaps of 4, 3 and 4 steps (exact in binary); the last point is alone.
TEST (Clusters, OfALineDependOnTheToleranceAndOnTheNumberOfNeighbors)
{
  Positions positions;
  for (const int at : {0, 1, 2, 6, 7, 8, 9, 10, 11, 14, 15, 16, 20})
    positions.emplace_back (0.25 * at, 0.0, 0.0);
  const auto clusters = [&] (double tolerance, int k, const std::vector<Index>& boundary_points) {
    return clusterBoundaryPoints (positions, boundary_points, tolerance, k, 1);
  };
  const std::vector<Index> all = indices (13);
  // Largest first, then by the smallest point. What is as far as the tolerance is inside.
  const Clusters apart{{3, 4, 5, 6, 7, 8}, {0, 1, 2}, {9, 10, 11}, {12}};
  EXPECT_EQ (clusters (0.25, 4, all), apart);
  EXPECT_EQ (clusters (0.75, 4, all), (Clusters{{3, 4, 5, 6, 7, 8, 9, 10, 11}, {0, 1, 2}, {12}}));
  EXPECT_EQ (clusters (1.0, 4, all), (Clusters{all}));
  EXPECT_EQ (clusters (0.2499, 4, all).size (), 13U);
  // The two nearest of each point but the last are on its side of a gap, and that one comes last:
  // the densest are first.
  EXPECT_EQ (clusters (1.0, 2, all), apart);
  // Only boundary points are joined, and count.
  EXPECT_EQ (clusters (0.25, 4, {3, 4, 6, 7}), (Clusters{{3, 4}, {6, 7}}));
  EXPECT_EQ (clusters (1.0, 4, {1}), (Clusters{{1}}));
  EXPECT_TRUE (clusters (1.0, 4, {}).empty ());
}

Report
discOf (const Positions& positions, BoundaryMethod method = BoundaryMethod::CONSENSUS)
{
  Options options = discOptions ();
  options.disc.boundary.method = method;
  return reconstruct (asInput (positions), options).report;
}

TEST (LoopOfSurface, IsTheOuterBorderOfASheet)
{
  const auto square = [] (double width, double height, double step, std::uint64_t seed,
                          double jitter = 0.3) {
    return fillOutlines ({resample (rectangle (width, height), step)}, step, jitter, seed);
  };
  const std::vector<std::pair<const char*, std::function<Sheet (std::uint64_t)>>> cases{
      {"disc", [] (std::uint64_t seed) { return disc (0.06, seed); }},
      {"square", [&] (std::uint64_t seed) { return square (1.0, 1.0, 0.04, seed); }},
      {"lattice", [&] (std::uint64_t seed) { return square (20.0, 20.0, 1.0, seed, 0.0); }},
      {"annulus",
       [] (std::uint64_t seed) {
         return fillOutlines ({circle (1.0, 0.06), circle (0.5, 0.06)}, 0.06, 0.35, seed);
       }},
      {"star",
       [] (std::uint64_t seed) {
         Outline corners;
         for (int i = 0; i < 12; ++i)
           corners.emplace_back (polar (i % 2 == 0 ? 1.0 : 0.5, PI * i / 6.0).head<2> ());
         return fillOutlines ({resample (corners, 0.03)}, 0.03, 0.25, seed);
       }},
      // The spacing varies by a factor of e^3 = 20.
      {"graded", [&] (std::uint64_t seed) {
         Sheet sheet = square (3.0, 4.0, 0.1, seed);
         for (Eigen::Vector3d& p : sheet.positions)
           p = polar (std::exp (p.x ()), p.y ());
         return sheet;
       }}};
  for (const auto& [name, make] : cases)
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE (name + std::to_string (seed));
      const Sheet sheet = make (seed);
      const std::vector<Index> loop = canonicalCycle (discOf (sheet.positions).loop);
      // The border in order, and inner points only where triangles at it are obtuse.
      std::vector<Index> border;
      std::copy_if (loop.begin (), loop.end (), std::back_inserter (border),
                    [&sheet] (Index p) { return p < sheet.border; });
      EXPECT_EQ (border, indices (sheet.border));
      EXPECT_LE (loop.size (), 1.05 * sheet.border);
    }
}

// Each point twice, a tenth of the spacing apart: one of each two is on the loop.
TEST (LoopOfSurface, HasPointsOnOthersOnce)
{
  const Sheet sheet = disc (0.06, 1);
  const std::size_t count = sheet.positions.size ();
  const Report report =
      discOf (joined (sheet.positions, placed (sheet.positions, {0.0, 0.0, 0.006})));
  std::vector<Index> loop = report.loop; // empty if there is no mesh
  for (Index& p : loop)
    p %= static_cast<Index> (count);
  EXPECT_EQ (canonicalCycle (loop), indices (sheet.border));
}

// Positions in the order of the border, by name.
std::vector<std::pair<std::string, Positions>>
borders ()
{
  // `count` points at even steps of the parameter, each moved by up to `jitter` steps.
  const auto sample = [] (const auto& curve, int count, double jitter) {
    RandomStream random (3);
    Positions positions;
    for (int i = 0; i < count; ++i)
      positions.push_back (
          curve (2.0 * PI * (i + jitter * (2.0 * random.uniform () - 1.0)) / count));
    return positions;
  };
  const auto round = [] (double angle) { return polar (1.0, angle); };
  const auto ellipse = [] (double angle) {
    return Eigen::Vector3d (3.0 * std::cos (angle), std::sin (angle), 0.0);
  };
  const auto star_in_space = [] (double angle) {
    return polar (1.0 + 0.4 * std::cos (5.0 * angle), angle, 0.3 * std::sin (3.0 * angle));
  };
  // By two orders of magnitude.
  const auto graded = [] (double angle) { return polar (1.0, angle + 0.98 * std::sin (angle)); };
  std::vector<std::pair<std::string, Positions>> all{
      {"ellipse 40", sample (ellipse, 40, 0.3)},
      {"ellipse 200", sample (ellipse, 200, 0.3)},
      {"star", sample (star_in_space, 300, 0.2)},
      // A square cloud of 25 million points has a border as long as this one.
      {"long", sample (star_in_space, 20000, 0.3)},
      {"graded", sample (graded, 400, 0.0)}};
  for (const int count : {5, 6, 7, 8, 13, 50, 101, 400})
    all.emplace_back ("circle " + std::to_string (count), sample (round, count, 0.0));
  all.emplace_back ("jagged", sample (round, 120, 0.0));
  for (std::size_t i = 1; i < 120; i += 2)
    all.back ().second[i] *= 0.97;
  for (const double side : {1.0, 3.0, 4.0, 10.0, 25.0}) { // with ties
    all.emplace_back ("rectangle " + std::to_string (side), Positions{});
    const double height = side == 1.0 ? 1.0 : 2.0 * side; // the least: four points
    for (const Eigen::Vector2d& p : resample (rectangle (side, height), 1.0))
      all.back ().second.emplace_back (p.x (), p.y (), 0.0);
  }
  return all;
}

TEST (TwoSegmentLoop, IsTheBorderWhateverTheNumbersOfItsPoints)
{
  for (const auto& [name, border] : borders ())
    for (std::uint64_t seed = 1; seed <= (border.size () < 1000 ? 8U : 1U); ++seed) {
      SCOPED_TRACE (name + ", seed " + std::to_string (seed));
      const std::vector<Index> order = permutation (border.size (), seed);
      Positions positions;
      for (const Index p : order)
        positions.push_back (border[p]);
      for (int i = 0; i < 20; ++i) // others, that are not in the cluster
        positions.emplace_back (0.01 * i, 0.0, 0.0);
      std::vector<Index> loop = twoSegmentLoop (positions, indices (border.size ()), 10, 1);
      for (Index& p : loop)
        p = order[p];
      EXPECT_EQ (canonicalCycle (loop), indices (border.size ()));
    }
}

TEST (TwoSegmentLoop, PointsWithoutAnOrderComeOnceEach)
{
  std::vector<Positions> clouds (1);
  for (int i = 0; i < 50; ++i)
    clouds.front ().emplace_back (i, 2.0 * i, 0.0); // a line
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
    clouds.push_back (randomPoints (4 + seed * seed / 3, seed));
  for (const Positions& positions : clouds) {
    std::vector<Index> loop = twoSegmentLoop (positions, indices (positions.size ()), 10, 1);
    std::sort (loop.begin (), loop.end ());
    EXPECT_EQ (loop, indices (positions.size ()));
  }
}

// A hole in the sheet is no border.
TEST (Boundary, EitherMethodFindsTheBorderOfASheetAndNoneOfASphere)
{
  const Outline rim = circle (1.0, 0.06), hole = circle (0.4, 0.06);
  for (const auto& [name, method] : BOUNDARY_CHOICES) {
    SCOPED_TRACE (name);
    for (const std::vector<Outline>& outlines :
         {std::vector<Outline>{rim}, std::vector<Outline>{rim, hole}}) {
      const Sheet sheet = fillOutlines (outlines, 0.06, 0.35, 6);
      const Report report = discOf (sheet.positions, method);
      EXPECT_EQ (canonicalCycle (report.loop), indices (sheet.border));
      EXPECT_GE (report.statistics.boundary_candidates, sheet.border);
    }
    const Report none = discOf (evenSphere (1500), method);
    EXPECT_EQ (none.status, RunStatus::NO_BOUNDARY);
    EXPECT_TRUE (none.loop.empty ());
  }
}

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
      const double right_of_side = cross (uv[i] - from, to - from) / (to - from).norm ();
      EXPECT_GE (right_of_side, i % 4 == 0 ? -1e-14 : 1e-9) << i;
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
  // A loop in a slanted plane. It goes from corner to corner in `steps` equal steps.
  const auto slantedLoop = [] (const Places& corners, int steps) {
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
  };
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

} // namespace
} // namespace pcl::floater
