// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary stage (TW 385, section 3): clusters of boundary points, both finders of loops.
#include "floater/boundary/boundary.h"

#include "options/option_rows.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <functional>

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

Eigen::Vector3d
onCircle (double angle)
{
  return {std::cos (angle), std::sin (angle), 0.0};
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
           corners.emplace_back ((i % 2 == 0 ? 1.0 : 0.5) * onCircle (PI * i / 6.0).head<2> ());
         return fillOutlines ({resample (corners, 0.03)}, 0.03, 0.25, seed);
       }},
      // The spacing varies by a factor of e^3 = 20.
      {"graded", [&] (std::uint64_t seed) {
         Sheet sheet = square (3.0, 4.0, 0.1, seed);
         for (Eigen::Vector3d& p : sheet.positions)
           p = std::exp (p.x ()) * onCircle (p.y ());
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

// `count` points at even steps of the parameter, each moved by up to `jitter` steps.
Positions
sample (const std::function<Eigen::Vector3d (double)>& curve, int count, double jitter)
{
  RandomStream random (3);
  Positions positions;
  for (int i = 0; i < count; ++i)
    positions.push_back (curve (2.0 * PI * (i + jitter * (2.0 * random.uniform () - 1.0)) / count));
  return positions;
}

// Positions in the order of the border, by name.
std::vector<std::pair<std::string, Positions>>
borders ()
{
  const auto ellipse = [] (double angle) {
    return Eigen::Vector3d (3.0 * std::cos (angle), std::sin (angle), 0.0);
  };
  const auto star_in_space = [] (double angle) -> Eigen::Vector3d {
    return (1.0 + 0.4 * std::cos (5.0 * angle)) * onCircle (angle) +
           0.3 * std::sin (3.0 * angle) * Eigen::Vector3d::UnitZ ();
  };
  // By two orders of magnitude.
  const auto graded = [] (double angle) { return onCircle (angle + 0.98 * std::sin (angle)); };
  std::vector<std::pair<std::string, Positions>> all{
      {"ellipse 40", sample (ellipse, 40, 0.3)},
      {"ellipse 200", sample (ellipse, 200, 0.3)},
      {"star", sample (star_in_space, 300, 0.2)},
      // A square cloud of 25 million points has a border as long as this one.
      {"long", sample (star_in_space, 20000, 0.3)},
      {"graded", sample (graded, 400, 0.0)}};
  for (const int count : {5, 6, 7, 8, 13, 50, 101, 400})
    all.emplace_back ("circle " + std::to_string (count), sample (onCircle, count, 0.0));
  all.emplace_back ("jagged", sample (onCircle, 120, 0.0));
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
      std::vector<Index> loop = twoSegmentLoop (positions, indices (border.size ()), 1);
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
    std::vector<Index> loop = twoSegmentLoop (positions, indices (positions.size ()), 1);
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

} // namespace
} // namespace pcl::floater
