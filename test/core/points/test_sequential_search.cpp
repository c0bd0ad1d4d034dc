// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The same neighbours as those of the tree, for points in any order.
#include "points/kd_tree.h"

#include "samples.h"

#include <gtest/gtest.h>

#include <numeric>

namespace pcl::floater {
namespace {
using samples::Positions;

void
compare (const Positions& points, const std::vector<Index>& queries)
{
  const KdTree tree (points);
  for (const std::size_t k : {std::size_t{1}, std::size_t{7}, std::size_t{21}}) {
    std::vector<Neighbor> expected;
    std::size_t next = 0;
    SequentialSearch (tree, points, k)
        .search (queries, [&] (std::size_t i, const std::vector<Neighbor>& found) {
          ASSERT_EQ (i, next++);
          tree.nearest (points[queries[i]], k, expected);
          ASSERT_EQ (found.size (), expected.size ());
          for (std::size_t n = 0; n < found.size (); ++n) {
            ASSERT_EQ (found[n].point, expected[n].point) << "neighbour " << n << " of query " << i;
            ASSERT_EQ (found[n].sqr_distance, expected[n].sqr_distance);
          }
        });
    EXPECT_EQ (next, queries.size ());
  }
}

std::vector<Index>
all (std::size_t count)
{
  std::vector<Index> points (count);
  std::iota (points.begin (), points.end (), Index{0});
  return points;
}

// Rows of a grid in z = 0, one after the other, so that each point is beside the one before.
Positions
rows (int side, double step)
{
  Positions points;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      points.emplace_back (step * (y % 2 == 0 ? x : side - 1 - x), step * y, 0.0);
  return points;
}

TEST (SequentialSearch, TiesOnAGridGoByIndex)
{
  const Positions grid = rows (60, 1.0 / 64.0);
  compare (grid, all (grid.size ()));
}

TEST (SequentialSearch, SomeOfThePointsWithJumps)
{
  Positions surface = rows (70, 0.01);
  RandomStream random (1);
  for (Eigen::Vector3d& p : surface)
    p += 0.003 * Eigen::Vector3d (random.normal (), random.normal (), random.normal ());
  compare (surface, all (surface.size ()));
  std::vector<Index> some;
  for (Index p = 0; p < surface.size (); ++p)
    if (p % 3 == 0 || p / 700 % 2 == 0)
      some.push_back (p);
  compare (surface, some);
  compare (surface, samples::permutation (surface.size (), 2));
}

TEST (SequentialSearch, AnySmallNumberOfPoints)
{
  for (std::size_t count = 1; count <= 50; ++count)
    compare (samples::randomPoints (count, count), all (count));
  compare (samples::randomPoints (10, 1), {});
}

TEST (SequentialSearch, UnevenDensityAndEqualPoints)
{
  Positions points = samples::randomPoints (3000, 3);
  for (Eigen::Vector3d& p : points)
    p = p.array ().pow (8.0);
  compare (points, all (points.size ()));
  std::sort (points.begin (), points.end (),
             [] (const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.x () < b.x (); });
  compare (points, all (points.size ()));
  Positions equal (100, Eigen::Vector3d (1, 2, 3));
  equal.resize (130, Eigen::Vector3d (1, 2, 4));
  compare (equal, all (equal.size ()));
}

// The squares of these distances are no normal numbers.
TEST (SequentialSearch, TinyDistances)
{
  const Positions tiny = rows (20, 1e-161);
  compare (tiny, all (tiny.size ()));
}

} // namespace
} // namespace pcl::floater
