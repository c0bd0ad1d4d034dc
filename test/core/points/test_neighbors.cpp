// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbour lists after points were removed.
#include "points/neighbors.h"

#include "points/point_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::BruteForceSearch;
using samples::Positions;
using samples::workingPoints;

// Chooses each point with the same probability, and all points of the cloud from `first_sure` on.
std::vector<Index>
chooseRemoved (const Points& points, double share, std::size_t first_sure, std::uint64_t seed)
{
  RandomStream random (seed);
  std::vector<Index> removed;
  for (Index p = 0; p < points.size (); ++p)
    if (random.uniform () < share || points.cloud_index[p] >= first_sure)
      removed.push_back (p);
  return removed;
}

// Expects that lists which are renewed after the removal of points are those that a search finds.
// \return the points that are left
Points
expectRenewed (const Points& all, const std::vector<Index>& removed,
               const NeighborSettings& settings)
{
  CsrLists before = findNeighbors (all, settings, 1);
  Points left = all;
  removePoints (left, removed);
  const CsrLists expected = findNeighbors (left, settings, 1);
  for (const int threads : {1, 3}) {
    const CsrLists renewed = renewNeighbors (left, removed, before, settings, threads);
    EXPECT_EQ (renewed.rows (), left.size ());
    EXPECT_EQ (renewed.offsets, expected.offsets);
    EXPECT_EQ (renewed.ids, expected.ids);
  }
  return left;
}

// The k nearest in one block and in several, and balls.
std::vector<NeighborSettings>
allSettings ()
{
  NeighborSettings nearest, few, blocks, balls;
  few.options.k = 6;
  blocks.blocks = 5;
  balls.options.kind = Neighborhood::BALL_DELAUNAY;
  return {nearest, few, blocks, balls};
}

// Whoever searches later shares the tree; where the search needed none, an earlier one is gone.
TEST (FindNeighbors, TheTreeOfAllPointsIsHandedOut)
{
  const Points points = workingPoints (samples::randomPoints (1500, 1));
  std::optional<KdTree> tree;
  for (const NeighborSettings& settings : allSettings ()) {
    const CsrLists alone = findNeighbors (points, settings, 1);
    const CsrLists with_tree = findNeighbors (points, settings, 2, &tree);
    EXPECT_EQ (with_tree.offsets, alone.offsets);
    EXPECT_EQ (with_tree.ids, alone.ids);
    const bool is_ball = settings.options.kind == Neighborhood::BALL_DELAUNAY;
    ASSERT_EQ (tree.has_value (), settings.blocks == 0 && !is_ball);
    if (!tree)
      continue;
    std::vector<Neighbor> found;
    tree->nearest (points.positions[7], 2, found);
    ASSERT_EQ (found.size (), 2U);
    EXPECT_EQ (found[0].point, 7U);
    EXPECT_EQ (found[1].point, alone.row (7)[0]);
  }
}

TEST (RenewNeighbors, OfRandomPoints)
{
  const Points points = workingPoints (samples::randomPoints (1500, 1));
  for (const NeighborSettings& settings : allSettings ())
    for (const double share : {0.0, 0.001, 0.02, 0.3, 0.9})
      for (std::uint64_t seed = 1; seed <= 3; ++seed)
        expectRenewed (points, chooseRemoved (points, share, points.size (), seed), settings);
}

// A grid is full of equal distances, where indices decide which points are the neighbours.
TEST (RenewNeighbors, OfAGridWithTies)
{
  Positions grid;
  for (const Index i : samples::permutation (1000, 2))
    grid.emplace_back (i % 10, i / 10 % 10, i / 100); // NOLINT (bugprone-integer-division)
  const Points points = workingPoints (grid);
  for (const NeighborSettings& settings : allSettings ())
    for (const double share : {0.01, 0.2})
      for (std::uint64_t seed = 1; seed <= 3; ++seed)
        expectRenewed (points, chooseRemoved (points, share, points.size (), seed), settings);
}

// Without the outermost points the bounding box is smaller, and the positions are scaled again.
TEST (RenewNeighbors, WhereTheBoxShrinks)
{
  for (const bool on_grid : {false, true}) {
    Positions cloud;
    for (int x = 0; x < 30; ++x)
      for (int y = 0; y < 30; ++y)
        cloud.emplace_back (x, y, 0.0);
    RandomStream random (3);
    for (Eigen::Vector3d& p : cloud)
      if (!on_grid)
        p += 0.3 * Eigen::Vector3d (random.uniform (), random.uniform (), random.uniform ());
    const std::size_t surface = cloud.size ();
    cloud.emplace_back (15.3, 14.8, 700.0);
    cloud.emplace_back (-90.0, 14.8, 3.0);
    cloud.emplace_back (15.1, 500.0, -33.0);
    const Points points = workingPoints (cloud);
    for (const NeighborSettings& settings : allSettings ())
      for (const double share : {0.0, 0.05}) {
        const std::vector<Index> removed = chooseRemoved (points, share, surface, 4);
        const Points left = expectRenewed (points, removed, settings);
        EXPECT_LT (left.scale, 0.1 * points.scale);
      }
  }
}

TEST (RenewNeighbors, ByTheCallersSearch)
{
  Positions cloud = samples::randomPoints (400, 5);
  cloud.emplace_back (20.0, 0.0, 0.0);
  BruteForceSearch search (cloud);
  for (NeighborSettings settings : allSettings ()) {
    settings.search = &search;
    const Points points = workingPoints (cloud);
    expectRenewed (points, chooseRemoved (points, 0.05, 400, 6), settings);
  }
}

TEST (RenewNeighbors, OfFewPoints)
{
  for (const std::size_t count : {1U, 2U, 5U, 12U, 25U}) {
    const Points points = workingPoints (samples::randomPoints (count, count));
    for (const NeighborSettings& settings : allSettings ()) {
      expectRenewed (points, chooseRemoved (points, 0.3, count, 7), settings);
      expectRenewed (points, samples::indices (count), settings);
    }
  }
}

} // namespace
} // namespace pcl::floater
