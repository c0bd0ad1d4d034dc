// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours in balls, and stars of all of them.
#include "points/neighbors.h"

#include "local/planar_star.h"
#include "points/point_samples.h"
#include "random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
using samples::workingPoints;

std::vector<Eigen::Vector3d>
plane (std::size_t count, std::uint64_t seed)
{
  RandomStream random (seed);
  std::vector<Eigen::Vector3d> points (count);
  for (Eigen::Vector3d& p : points) {
    const double x = random.uniform (), y = random.uniform ();
    p = {40.0 * x * x, 40.0 * y, 0.0}; // denser at one side
  }
  return points;
}

// By trying all points.
std::vector<Index>
ballBySearchingAll (const Points& points, Index p, double radius)
{
  std::vector<Neighbor> others;
  for (Index q = 0; q < points.positions.size (); ++q)
    if (q != p)
      others.push_back ({(points.positions[q] - points.positions[p]).squaredNorm (), q});
  std::sort (others.begin (), others.end ());
  double spacing = 0.0;
  for (std::size_t i = 0; i < 6; ++i)
    spacing += std::sqrt (others[i].sqr_distance) / 6.0;
  std::vector<Index> ball;
  for (const Neighbor& neighbor : others)
    if (ball.size () < 200 &&
        (ball.size () < 6 || std::sqrt (neighbor.sqr_distance) <= radius * spacing))
      ball.push_back (neighbor.point);
  return ball;
}

CsrLists
findBalls (const Points& points, double radius, const RunContext& run = 1)
{
  return findBallNeighbors (points.positions, Rows::all (points.size ()), radius, run);
}

TEST (BallNeighbors, FollowTheDensity)
{
  const std::vector<Eigen::Vector3d> positions = plane (1500, 1);
  const Points points = workingPoints (positions);
  const CsrLists balls = findBalls (points, 2.5, 2);
  ASSERT_EQ (balls.rows (), points.positions.size ());
  for (Index p = 0; p < balls.rows (); p += 7) {
    const Row row = balls.row (p);
    ASSERT_EQ (std::vector<Index> (row.begin (), row.end ()), ballBySearchingAll (points, p, 2.5));
  }
  const double mean = static_cast<double> (balls.ids.size ()) / 1500.0;
  EXPECT_GT (mean, 15.0);
  EXPECT_LT (mean, 25.0);
}

TEST (BallNeighbors, AreTheSameByTheCallersSearch)
{
  const std::vector<Eigen::Vector3d> positions = plane (800, 2);
  const Points points = workingPoints (positions);
  const CsrLists own = findBalls (points, 3.0);
  for (const bool knows_radii : {true, false}) {
    samples::BruteForceSearch search (positions);
    search.knows_radii = knows_radii;
    CallerSearch caller (points, search);
    const CsrLists balls = searchBallNeighbors (caller, Rows::all (points.size ()), 3.0, 2);
    EXPECT_EQ (balls.offsets, own.offsets);
    EXPECT_EQ (balls.ids, own.ids);
  }
}

TEST (BallNeighbors, AreNeitherFewNorTooMany)
{
  // A crowd, and a few points with a ball that holds all of it.
  RandomStream random (3);
  std::vector<Eigen::Vector3d> positions (1000);
  for (Eigen::Vector3d& p : positions)
    p = {1e-3 * random.uniform (), 1e-3 * random.uniform (), 0.0};
  positions.emplace_back (1.0, 0.0, 0.0);
  for (int i = 0; i < 5; ++i)
    positions.emplace_back (1.0 + 1e-9 * (i + 1), 1e-9 * i * i, 0.0);
  const Points points = workingPoints (positions);
  const CsrLists balls = findBalls (points, 1.0);
  for (Index p = 0; p < balls.rows (); ++p) {
    EXPECT_GE (balls.row (p).size (), 6U);
    EXPECT_LE (balls.row (p).size (), 200U);
  }
  const CsrLists few = findBalls (workingPoints (plane (4, 4)), 2.5);
  for (Index p = 0; p < 4; ++p)
    EXPECT_EQ (few.row (p).size (), 3U);
}

TEST (PlanarStarOfAll, GoesRoundAndBeginsAfterTheGap)
{
  RandomStream random (5);
  for (int round = 0; round < 200; ++round) {
    // Directions of a grid, several in one; in half of the rounds on one side only.
    std::vector<PlanarNeighbor> neighbors;
    for (Index i = 0; i < 30; ++i) {
      const double x = static_cast<double> (random.below (7)) - 3.0;
      const double y = static_cast<double> (random.below (7)) - 3.0;
      if ((x != 0.0 || y != 0.0) && (round % 2 == 0 || y > 0.0))
        neighbors.push_back ({{x, y}, i});
    }
    const std::size_t count = neighbors.size ();
    ASSERT_GE (count, 5U);
    PlanarStar star;
    std::vector<PlanarNeighbor> delaunay = neighbors;
    const bool open = star.order (neighbors);
    EXPECT_EQ (neighbors.size (), count);
    const double widest = star.openingAngle ();
    EXPECT_EQ (open, star.make (delaunay));
    EXPECT_EQ (widest, star.openingAngle ());
    EXPECT_TRUE (open || round % 2 == 0);
    double turn = 0.0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const Eigen::Vector2d &a = neighbors[i].offset, &b = neighbors[i + 1].offset;
      const double angle = std::atan2 (a.x () * b.y () - a.y () * b.x (), a.dot (b));
      EXPECT_GE (angle, 0.0);
      turn += angle;
    }
    EXPECT_LT (turn, 6.3);
    if (open) {
      EXPECT_NEAR (turn + widest, 6.283185307179586, 1e-12);
    }
  }
}

} // namespace
} // namespace pcl::floater
