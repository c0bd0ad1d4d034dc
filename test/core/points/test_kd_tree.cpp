// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The tree against trying all points, and the sequential search against the tree.
#include "points/kd_tree.h"

#include "points/point_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::indices;
using samples::Positions;

void
expectFound (const std::vector<Neighbor>& found, const std::vector<Neighbor>& expected,
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
expectRightTree (const KdTree& tree, const Positions& points)
{
  RandomStream random (points.size ());
  std::vector<Neighbor> found;
  for (std::size_t i = 0; i < std::min<std::size_t> (points.size (), 60); ++i) {
    Eigen::Vector3d query = points[random.below (points.size ())];
    if (i % 3 == 1)
      query = 0.5 * (query + points[random.below (points.size ())]);
    if (i % 3 == 2)
      query += 3.0 * samples::normalVector (random);
    const std::vector<Neighbor> expected =
        samples::nearestByTryingAll (points, query, points.size ());
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{21}}) {
      tree.nearest (query, k, found);
      expectFound (found, expected, std::min (k, points.size ()));
    }
    // Radii that end exactly at a point, and between points.
    const double farthest = std::sqrt (expected[expected.size () / 3].sqr_distance);
    for (const double radius : {farthest, 1.01 * farthest, 0.0}) {
      tree.within (query, radius, found);
      const auto beyond =
          std::find_if (expected.begin (), expected.end (), [radius] (const Neighbor& neighbor) {
            return neighbor.sqr_distance > radius * radius;
          });
      expectFound (found, expected, static_cast<std::size_t> (beyond - expected.begin ()));
      expectCollected (tree, query, radius, found);
    }
  }
}

void
expectSameInSequence (const KdTree& tree, const Positions& points,
                      const std::vector<Index>& queries)
{
  for (const std::size_t k : {std::size_t{1}, std::size_t{7}, std::size_t{21}}) {
    std::vector<Neighbor> expected;
    std::size_t next = 0;
    SequentialSearch (tree, points, k)
        .search (queries, [&] (std::size_t i, const std::vector<Neighbor>& found) {
          ASSERT_EQ (i, next++);
          tree.nearest (points[queries[i]], k, expected);
          expectFound (found, expected, expected.size ());
        });
    EXPECT_EQ (next, queries.size ());
  }
}

// Along the points, along x, with jumps, in any order, and for none.
void
expectRightSearches (const Positions& points)
{
  const KdTree tree (points);
  expectRightTree (tree, points);
  expectRightTree (KdTree (points, 1, PointOrder::ALONG_CURVE), points);
  std::vector<Index> along_x = indices (points.size ()), some;
  std::sort (along_x.begin (), along_x.end (),
             [&] (Index a, Index b) { return points[a].x () < points[b].x (); });
  for (Index p = 0; p < points.size (); ++p)
    if (p % 3 == 0 || p / 700 % 2 == 0)
      some.push_back (p);
  for (const std::vector<Index>& queries : {indices (points.size ()), along_x, some,
                                            samples::permutation (points.size (), 2), indices (0)})
    expectSameInSequence (tree, points, queries);
}

// Rows of a grid in z = 0, one after the other, so that each point is beside the one before.
Positions
toAndFro (int side, double step)
{
  Positions points;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      points.emplace_back (step * (y % 2 == 0 ? x : side - 1 - x), step * y, 0.0);
  return points;
}

TEST (KdTree, FindsTheSameAsTryingAll)
{
  Positions cube, line, uneven = samples::randomPoints (3000, 9), rough = toAndFro (70, 0.01);
  for (const Index i : samples::permutation (1331, 4)) // ties go by index
    cube.emplace_back (i % 11, i / 11 % 11, i / 121);  // NOLINT (bugprone-integer-division)
  for (const Index i : samples::permutation (500, 6))
    line.emplace_back (0.1 * i, -0.2 * i, 0.3 * i);
  for (Eigen::Vector3d& p : uneven)
    p = p.array ().pow (8.0);
  RandomStream random (1);
  for (Eigen::Vector3d& p : rough)
    p += 0.003 * samples::normalVector (random);
  Positions equal (100, Eigen::Vector3d (1, 2, 3));
  equal.resize (130, Eigen::Vector3d (1, 2, 4));
  // The squares of the last distances are no normal numbers.
  const std::vector<Positions> clouds{samples::randomPoints (3000, 1),
                                      cube,
                                      line,
                                      equal,
                                      uneven,
                                      rough,
                                      toAndFro (60, 1.0 / 64.0),
                                      toAndFro (20, 1e-161)};
  for (std::size_t cloud = 0; cloud < clouds.size (); ++cloud) {
    SCOPED_TRACE (cloud);
    expectRightSearches (clouds[cloud]);
  }
}

TEST (KdTree, AnySmallNumberOfPoints)
{
  for (std::size_t count = 1; count <= 50; ++count)
    expectRightSearches (samples::randomPoints (count, count));
  std::vector<Neighbor> found (3);
  const KdTree empty ({});
  empty.nearest (Eigen::Vector3d::Zero (), 5, found);
  EXPECT_TRUE (found.empty ());
  found.resize (3);
  empty.within (Eigen::Vector3d::Zero (), 5.0, found);
  EXPECT_TRUE (found.empty ());
}

} // namespace
} // namespace pcl::floater
