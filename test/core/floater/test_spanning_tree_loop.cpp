// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/spanning_tree_loop.h"

#include "samples.h"

#include <gtest/gtest.h>

#include <complex>

namespace pcl::floater {
namespace {
using samples::canonicalCycle;
using samples::Outline;
using samples::PI;
using samples::Positions;
using samples::Sheet;

// A boundary whose points are cloud indices.
Boundary
boundaryOf (const Positions& positions)
{
  const samples::Neighborhoods made = samples::makeNeighborhoods (positions);
  Boundary boundary =
      spanningTreeLoop (made.points.positions, made.geometry.stars, made.geometry.spacing, 1);
  EXPECT_FALSE (boundary.problem);
  std::vector<Index> cloud;
  for (const Index p : boundary.loop)
    cloud.push_back (made.points.cloud_index[p]);
  EXPECT_EQ (std::set<Index> (cloud.begin (), cloud.end ()).size (), cloud.size ());
  boundary.loop = std::move (cloud);
  if (boundary.longest_from != NONE)
    boundary.longest_from = made.points.cloud_index[boundary.longest_from];
  return boundary;
}

std::vector<Index>
loopOf (const Positions& positions)
{
  return boundaryOf (positions).loop;
}

// All points of the outer border in order.
void
expectBorder (const Sheet& sheet)
{
  EXPECT_EQ (canonicalCycle (loopOf (sheet.positions)), samples::indices (sheet.border));
}

// Most of the border, in order, and nothing else: it is open how the border passes a corner or a
// jag of the sampling.
void
expectMostOfBorder (const Sheet& sheet, double share)
{
  const std::vector<Index> loop = canonicalCycle (loopOf (sheet.positions));
  EXPECT_GE (static_cast<double> (loop.size ()), share * static_cast<double> (sheet.border));
  EXPECT_TRUE (std::is_sorted (loop.begin (), loop.end ()));
  EXPECT_TRUE (loop.empty () || loop.back () < sheet.border);
}

TEST (SpanningTreeLoop, RoundSheets)
{
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    expectBorder (samples::disc (0.06, seed));
}

TEST (SpanningTreeLoop, MeasuresItsSteps)
{
  const Sheet sheet = samples::disc (0.06, 1);
  const Boundary boundary = boundaryOf (sheet.positions);
  EXPECT_EQ (boundary.loop.size (), sheet.border);
  EXPECT_GE (boundary.candidates, boundary.loop.size ());
  double length = 0.0;
  for (std::size_t i = 0; i < boundary.loop.size (); ++i)
    length += (sheet.positions[boundary.loop[(i + 1) % boundary.loop.size ()]] -
               sheet.positions[boundary.loop[i]])
                  .norm ();
  EXPECT_NEAR (length, 2.0 * PI, 0.028);
  EXPECT_GT (boundary.largest_step, 0.7);
  EXPECT_LT (boundary.largest_step, 1.3);
  EXPECT_LT (boundary.longest_from, sheet.border);
}

TEST (SpanningTreeLoop, SquareSheet)
{
  const double step = 1.0 / 25.0;
  const Outline square = samples::resample ({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, step);
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    expectBorder (samples::fillOutlines ({square}, step, 0.3, seed));
}

TEST (SpanningTreeLoop, RegularGrid)
{
  Sheet sheet;
  const int side = 20;
  const auto add = [&sheet] (int x, int y) { sheet.positions.emplace_back (x, y, 0.0); };
  for (int i = 0; i < side; ++i)
    add (i, 0);
  for (int i = 0; i < side; ++i)
    add (side, i);
  for (int i = 0; i < side; ++i)
    add (side - i, side);
  for (int i = 0; i < side; ++i)
    add (0, side - i);
  sheet.border = sheet.positions.size ();
  for (int x = 1; x < side; ++x)
    for (int y = 1; y < side; ++y)
      add (x, y);
  expectBorder (sheet);
}

TEST (SpanningTreeLoop, IsTheOuterBorderOfAnAnnulus)
{
  const double step = 0.06;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    expectBorder (samples::fillOutlines ({samples::circle (1.0, step), samples::circle (0.5, step)},
                                         step, 0.35, seed));
}

TEST (SpanningTreeLoop, StarShapedBorder)
{
  Outline corners;
  for (int i = 0; i < 12; ++i) {
    const double radius = i % 2 == 0 ? 1.0 : 0.5;
    corners.emplace_back (radius * std::cos (PI * i / 6.0), radius * std::sin (PI * i / 6.0));
  }
  const double step = 0.03;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    expectMostOfBorder (
        samples::fillOutlines ({samples::resample (corners, step)}, step, 0.25, seed), 0.97);
}

TEST (SpanningTreeLoop, CombShapedBorder)
{
  // Five teeth, 6 steps wide and 30 high, with spaces of 5 steps.
  const double step = 1.0 / 60.0;
  Outline corners = {{0, 0}, {50, 0}};
  for (int tooth = 4; tooth >= 0; --tooth) {
    const double left = 11.0 * tooth;
    if (tooth < 4)
      corners.emplace_back (left + 6.0, 15.0);
    corners.emplace_back (left + 6.0, 45.0);
    corners.emplace_back (left, 45.0);
    if (tooth > 0)
      corners.emplace_back (left, 15.0);
  }
  for (Eigen::Vector2d& corner : corners)
    corner *= step;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    expectMostOfBorder (
        samples::fillOutlines ({samples::resample (corners, step)}, step, 0.25, seed), 0.94);
}

TEST (SpanningTreeLoop, GradedDensity)
{
  // A jittered rectangle mapped by exp (z): the spacing varies by a factor of e^3 = 20.
  const double step = 0.1;
  const Outline rectangle = samples::resample ({{0, 0}, {3, 0}, {3, 4}, {0, 4}}, step);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Sheet sheet = samples::fillOutlines ({rectangle}, step, 0.3, seed);
    for (Eigen::Vector3d& p : sheet.positions) {
      const std::complex<double> graded = std::exp (std::complex<double> (p.x (), p.y ()));
      p = {graded.real (), graded.imag (), 0.0};
    }
    expectMostOfBorder (sheet, 0.98);
  }
}

TEST (SpanningTreeLoop, CurvedSheets)
{
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Sheet sheet = samples::disc (0.06, seed);
    for (Eigen::Vector3d& p : sheet.positions) { // more than half a sphere
      const double polar = 1.9 * p.norm ();
      const double azimuth = std::atan2 (p.y (), p.x ());
      p = {std::sin (polar) * std::cos (azimuth), std::sin (polar) * std::sin (azimuth),
           std::cos (polar)};
    }
    expectMostOfBorder (sheet, 0.95);
  }
}

TEST (SpanningTreeLoop, DoesNotChangeUnderPermutationAndMotion)
{
  Sheet sheet = samples::disc (0.06, 5);
  for (Eigen::Vector3d& p : sheet.positions)
    p.z () = 0.3 * std::sin (3.0 * p.x ()) * std::cos (2.0 * p.y ());
  const std::vector<Index> expected = canonicalCycle (loopOf (sheet.positions));
  EXPECT_GE (expected.size (), sheet.border);
  const std::vector<Index> order = samples::permutation (sheet.positions.size (), 6);
  const Eigen::Affine3d motion = Eigen::Translation3d (-3, 5, 40) *
                                 Eigen::AngleAxisd (2.2, Eigen::Vector3d (3, 1, -2).normalized ()) *
                                 Eigen::Scaling (17.0);
  Positions changed;
  for (const Index p : order)
    changed.push_back (motion * sheet.positions[p]);
  std::vector<Index> found = loopOf (changed);
  for (Index& p : found)
    p = order[p];
  EXPECT_EQ (canonicalCycle (found), expected);
}

TEST (SpanningTreeLoop, IsEmptyForAClosedSurface)
{
  Positions sphere (2000);
  for (std::size_t i = 0; i < sphere.size (); ++i) { // a spiral from pole to pole
    const double z = 1.0 - 2.0 * (static_cast<double> (i) + 0.5) / 2000.0;
    const double angle = PI * (3.0 - std::sqrt (5.0)) * static_cast<double> (i);
    sphere[i] = {std::sqrt (1.0 - z * z) * std::cos (angle),
                 std::sqrt (1.0 - z * z) * std::sin (angle), z};
  }
  const Boundary boundary = boundaryOf (sphere);
  EXPECT_TRUE (boundary.loop.empty ());
  EXPECT_EQ (boundary.candidates, 0U);
}

TEST (SpanningTreeLoop, FewPoints)
{
  EXPECT_TRUE (loopOf ({}).empty ());
  EXPECT_TRUE (loopOf ({{0, 0, 0}}).empty ());
  EXPECT_TRUE (loopOf ({{0, 0, 0}, {1, 0, 0}}).empty ());
  const std::vector<Index> square = loopOf ({{0, 0, 0}, {1, 0, 0}, {1, 1.1, 0}, {0, 1, 0}});
  EXPECT_EQ (canonicalCycle (square), (std::vector<Index>{0, 1, 2, 3}));
}

} // namespace
} // namespace pcl::floater
