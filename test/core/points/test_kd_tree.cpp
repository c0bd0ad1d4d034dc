// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/kd_tree.h"

#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Positions;

std::vector<Neighbor>
byBruteForce (const Positions& points, const Eigen::Vector3d& query)
{
  std::vector<Neighbor> all;
  for (std::size_t p = 0; p < points.size (); ++p)
    all.push_back ({(points[p] - query).squaredNorm (), static_cast<Index> (p)});
  std::sort (all.begin (), all.end ());
  return all;
}

void
expectEqual (const std::vector<Neighbor>& found, const std::vector<Neighbor>& expected,
             std::size_t count)
{
  ASSERT_EQ (found.size (), count);
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_EQ (found[i].point, expected[i].point) << "neighbour " << i;
    ASSERT_EQ (found[i].sqr_distance, expected[i].sqr_distance);
  }
}

// All points within a radius, in any order, if there are not more than are wanted.
void
expectCollected (const KdTree& tree, const Eigen::Vector3d& query, double radius,
                 const std::vector<Neighbor>& expected)
{
  std::vector<Index> points, wanted;
  for (const Neighbor& neighbor : expected)
    wanted.push_back (neighbor.point);
  std::sort (wanted.begin (), wanted.end ());
  ASSERT_TRUE (tree.collect (query, radius, wanted.size (), points));
  std::sort (points.begin (), points.end ());
  EXPECT_EQ (points, wanted);
  if (!wanted.empty ()) {
    EXPECT_FALSE (tree.collect (query, radius, wanted.size () - 1, points));
  }
}

// Queries at the points themselves, between them and outside of their box.
void
compareTree (const KdTree& tree, const Positions& points, std::size_t queries, std::uint64_t seed)
{
  RandomStream random (seed);
  std::vector<Neighbor> found;
  for (std::size_t i = 0; i < queries; ++i) {
    Eigen::Vector3d query = points[random.below (points.size ())];
    if (i % 3 == 1)
      query = 0.5 * (query + points[random.below (points.size ())]);
    if (i % 3 == 2)
      query += 3.0 * Eigen::Vector3d (random.normal (), random.normal (), random.normal ());
    const std::vector<Neighbor> expected = byBruteForce (points, query);
    for (const std::size_t k : {std::size_t{1}, std::size_t{7}, std::size_t{21}}) {
      tree.nearest (query, k, found);
      expectEqual (found, expected, std::min (k, points.size ()));
    }
    // Radii that end exactly at a point, and between points.
    const double farthest = std::sqrt (expected[expected.size () / 3].sqr_distance);
    for (const double radius : {farthest, 1.01 * farthest, 0.0}) {
      tree.within (query, radius, found);
      const auto beyond =
          std::find_if (expected.begin (), expected.end (), [radius] (const Neighbor& neighbor) {
            return neighbor.sqr_distance > radius * radius;
          });
      expectEqual (found, expected, static_cast<std::size_t> (beyond - expected.begin ()));
      expectCollected (tree, query, radius, found);
    }
  }
}

void
compare (const Positions& points, std::size_t queries, std::uint64_t seed)
{
  for (const PointOrder order : {PointOrder::ANY, PointOrder::ALONG_CURVE})
    compareTree (KdTree (points, 1, order), points, queries, seed);
}

TEST (KdTree, RandomPoints)
{
  compare (samples::randomPoints (3000, 1), 150, 2);
}

TEST (KdTree, AnySmallNumberOfPoints)
{
  for (std::size_t count = 1; count <= 50; ++count)
    compare (samples::randomPoints (count, count), 12, 3);
}

TEST (KdTree, TiesOnAGridGoByIndex)
{
  Positions grid;
  for (int x = 0; x < 11; ++x)
    for (int y = 0; y < 11; ++y)
      for (int z = 0; z < 11; ++z)
        grid.emplace_back (x, y, z);
  Positions shuffled;
  for (const Index i : samples::permutation (grid.size (), 4))
    shuffled.push_back (grid[i]);
  compare (shuffled, 150, 5);
}

TEST (KdTree, PointsOnALine)
{
  Positions line;
  for (const Index i : samples::permutation (500, 6))
    line.emplace_back (0.1 * i, -0.2 * i, 0.3 * i);
  compare (line, 60, 7);
}

TEST (KdTree, EqualPoints)
{
  Positions points (100, Eigen::Vector3d (1, 2, 3));
  points.resize (130, Eigen::Vector3d (1, 2, 4));
  compare (points, 30, 8);
}

TEST (KdTree, UnevenDensity)
{
  Positions points = samples::randomPoints (1500, 9);
  for (Eigen::Vector3d& p : points)
    p = p.array ().pow (8.0);
  compare (points, 150, 10);
}

TEST (KdTree, EmptyTreeAndZeroNeighbors)
{
  std::vector<Neighbor> found (3);
  const KdTree empty ({});
  empty.nearest (Eigen::Vector3d::Zero (), 5, found);
  EXPECT_TRUE (found.empty ());
  found.resize (3);
  empty.within (Eigen::Vector3d::Zero (), 5.0, found);
  EXPECT_TRUE (found.empty ());
  found.resize (3);
  KdTree (samples::randomPoints (30, 11)).nearest (Eigen::Vector3d::Zero (), 0, found);
  EXPECT_TRUE (found.empty ());
}

} // namespace
} // namespace pcl::floater
