// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Order of a boundary cluster by two segments (TW 385, section 3.3).
#include "floater/boundary/two_segment_loop.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace pcl::floater {
namespace {
using Positions = std::vector<Eigen::Vector3d>;

// The same cycle from its smallest point on, towards that one's smaller neighbour.
std::vector<Index>
canonical (std::vector<Index> loop)
{
  std::rotate (loop.begin (), std::min_element (loop.begin (), loop.end ()), loop.end ());
  if (loop.size () > 2 && loop[1] > loop.back ())
    std::reverse (loop.begin () + 1, loop.end ());
  return loop;
}

// Orders the points of a border from several seeds, each time in a shuffled numbering, and expects
// the border.
// \param border positions in the order of the border
void
expectBorder (const Positions& border)
{
  std::mt19937 random (5);
  for (int round = 0; round < 8; ++round) {
    std::vector<Index> shuffled =
        samples::indices (border.size ()); // place on the border of each new number
    std::shuffle (shuffled.begin (), shuffled.end (), random);
    Positions positions;
    for (const Index p : shuffled)
      positions.push_back (border[p]);
    std::vector<Index> loop = twoSegmentLoop (positions, samples::indices (positions.size ()), 1);
    for (Index& p : loop)
      p = shuffled[p];
    ASSERT_EQ (canonical (loop), samples::indices (border.size ())) << "shuffle " << round;
  }
}

void
expectEachOnce (std::vector<Index> loop, const std::vector<Index>& cluster)
{
  std::sort (loop.begin (), loop.end ());
  EXPECT_EQ (loop, cluster);
}

// `count` points at even steps of the parameter, each moved by up to `jitter` steps.
template <typename Curve>
Positions
sample (const Curve& curve, int count, double jitter)
{
  std::mt19937 random (3);
  std::uniform_real_distribution<double> uniform (-jitter, jitter);
  Positions positions;
  for (int i = 0; i < count; ++i)
    positions.push_back (curve (2.0 * PI * (i + uniform (random)) / count));
  return positions;
}

Eigen::Vector3d
circle (double angle)
{
  return {std::cos (angle), std::sin (angle), 0.0};
}

Eigen::Vector3d
star (double angle)
{
  const double radius = 1.0 + 0.4 * std::cos (5.0 * angle);
  return {radius * std::cos (angle), radius * std::sin (angle), 0.3 * std::sin (3.0 * angle)};
}

TEST (TwoSegmentLoop, Circle)
{
  for (const int count : {5, 6, 7, 8, 13, 50, 101, 400})
    expectBorder (sample (circle, count, 0.0));
}

TEST (TwoSegmentLoop, UnevenEllipse)
{
  const auto ellipse = [] (double angle) {
    return Eigen::Vector3d (3.0 * std::cos (angle), std::sin (angle), 0.0);
  };
  for (const int count : {40, 200})
    expectBorder (sample (ellipse, count, 0.3));
}

TEST (TwoSegmentLoop, StarInSpace)
{
  expectBorder (sample (star, 300, 0.2));
}

TEST (TwoSegmentLoop, DensityGradedByTwoOrdersOfMagnitude)
{
  const auto graded = [] (double angle) { return circle (angle + 0.98 * std::sin (angle)); };
  expectBorder (sample (graded, 400, 0.0));
}

TEST (TwoSegmentLoop, JaggedBorder)
{
  Positions border;
  for (int i = 0; i < 120; ++i)
    border.push_back ((i % 2 == 0 ? 1.0 : 0.97) * circle (2.0 * PI * i / 120.0));
  expectBorder (border);
}

TEST (TwoSegmentLoop, RectangleWithTies)
{
  for (const int side : {3, 4, 10, 25}) {
    Positions border;
    for (int i = 0; i < side; ++i)
      border.emplace_back (i, 0.0, 0.0);
    for (int i = 0; i < 2 * side; ++i)
      border.emplace_back (side, i, 0.0);
    for (int i = 0; i < side; ++i)
      border.emplace_back (side - i, 2.0 * side, 0.0);
    for (int i = 0; i < 2 * side; ++i)
      border.emplace_back (0.0, 2.0 * side - i, 0.0);
    SCOPED_TRACE (testing::Message () << "side " << side);
    expectBorder (border);
  }
}

// Each dash has more points than a neighbourhood can have, so only bridges lead to the next one.
TEST (TwoSegmentLoop, DashedCircle)
{
  for (const int dashes : {2, 3, 17}) {
    Positions border;
    for (int dash = 0; dash < dashes; ++dash)
      for (int i = 0; i < 40; ++i)
        border.push_back (circle (2.0 * PI * (dash + 0.015 * i) / dashes));
    SCOPED_TRACE (testing::Message () << "dashes " << dashes);
    expectBorder (border);
  }
}

TEST (TwoSegmentLoop, Square)
{
  expectBorder ({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
}

TEST (TwoSegmentLoop, IsEmptyForFewerThanFourPoints)
{
  const Positions positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_TRUE (twoSegmentLoop (positions, {}, 1).empty ());
  EXPECT_TRUE (twoSegmentLoop (positions, {2}, 1).empty ());
  EXPECT_TRUE (twoSegmentLoop (positions, {0, 1, 3}, 1).empty ());
  EXPECT_EQ (twoSegmentLoop (positions, {0, 1, 2, 3}, 1).size (), 4U);
}

TEST (TwoSegmentLoop, IsEmptyForCoincidentPoints)
{
  const Positions circle_points = sample (circle, 12, 0.0);
  for (const Eigen::Vector3d& twin : circle_points) {
    Positions positions = circle_points;
    positions.push_back (twin);
    EXPECT_TRUE (twoSegmentLoop (positions, samples::indices (positions.size ()), 1).empty ());
  }
}

TEST (TwoSegmentLoop, OrdersTheClusterAmongOtherPoints)
{
  Positions positions;
  std::vector<Index> cluster;
  for (int i = 0; i < 60; ++i) {
    positions.push_back (circle (2.0 * PI * i / 60.0));
    cluster.push_back (static_cast<Index> (positions.size () - 1));
    positions.emplace_back (0.01 * i, 0.0, 0.0);
  }
  EXPECT_EQ (canonical (twoSegmentLoop (positions, cluster, 1)), cluster);
}

// In a band of two rows it is open which row comes first, but the order along the band is not.
TEST (TwoSegmentLoop, ThickBandIsFollowedAlongItsLength)
{
  constexpr int columns = 100;
  Positions positions;
  for (int i = 0; i < columns; ++i)
    for (const double radius : {1.0, 1.05})
      positions.push_back (radius * circle (2.0 * PI * i / columns));
  const std::vector<Index> loop =
      twoSegmentLoop (positions, samples::indices (positions.size ()), 1);
  expectEachOnce (loop, samples::indices (positions.size ()));
  ASSERT_EQ (loop.size (), positions.size ());
  int around = 0;
  for (std::size_t i = 0; i < loop.size (); ++i) {
    const int column = static_cast<int> (loop[i] / 2);
    const int next = static_cast<int> (loop[(i + 1) % loop.size ()] / 2);
    int step = (next - column + columns) % columns;
    if (step > columns / 2)
      step -= columns;
    EXPECT_LE (std::abs (step), 3) << "after place " << i;
    around += step;
  }
  EXPECT_EQ (std::abs (around), columns);
}

TEST (TwoSegmentLoop, DisorderlyPointsComeOnceEach)
{
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE (testing::Message () << "seed " << seed);
    std::mt19937 random (seed);
    std::uniform_real_distribution<double> uniform (0.0, 1.0);
    Positions positions;
    for (unsigned i = 0; i < 4 + seed * seed / 3; ++i)
      positions.emplace_back (uniform (random), uniform (random), uniform (random));
    const std::vector<Index> loop =
        twoSegmentLoop (positions, samples::indices (positions.size ()), 1);
    expectEachOnce (loop, samples::indices (positions.size ()));
  }
}

TEST (TwoSegmentLoop, PointsOfALineComeOnceEach)
{
  Positions positions;
  for (int i = 0; i < 50; ++i)
    positions.emplace_back (i, 2.0 * i, 0.0);
  expectEachOnce (twoSegmentLoop (positions, samples::indices (positions.size ()), 1),
                  samples::indices (positions.size ()));
}

TEST (TwoSegmentLoop, DoesNotChangeUnderMotionAndScaling)
{
  const Positions border = sample (star, 150, 0.3);
  const std::vector<Index> loop = twoSegmentLoop (border, samples::indices (border.size ()), 1);
  const Eigen::AngleAxisd rotation (0.7, Eigen::Vector3d (1.0, 2.0, -1.0).normalized ());
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Positions moved;
    for (const Eigen::Vector3d& p : border)
      moved.push_back (scale * (rotation * p + Eigen::Vector3d (3.0, -1.0, 2.0)));
    EXPECT_EQ (twoSegmentLoop (moved, samples::indices (moved.size ()), 1), loop)
        << "scale " << scale;
  }
}

// A square cloud of 25 million points has a border as long as this one.
TEST (TwoSegmentLoop, LongBorder)
{
  const Positions border = sample (star, 20000, 0.3);
  EXPECT_EQ (canonical (twoSegmentLoop (border, samples::indices (border.size ()), 1)),
             samples::indices (border.size ()));
}

} // namespace
} // namespace pcl::floater
