// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/net.h"

#include "points/point_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
using samples::indices;
using samples::Positions;
using samples::workingPoints;

// A jittered sheet of `side` x `side` points a unit apart, and copies of its first points, up to
// `offset` away.
Positions
stackedSheet (int side, std::size_t stacked, std::size_t copies, double offset, bool along_normal)
{
  RandomStream random (7);
  Positions points = samples::jitteredGrid (side, side, 1.0, 0.4, random);
  for (Eigen::Vector3d& p : points)
    p.z () = 3.0 * std::sin (0.1 * p.x ());
  const std::size_t n = points.size ();
  for (std::size_t c = 0; c < copies; ++c)
    for (std::size_t i = 0; i < std::min (stacked, n); ++i) {
      const Eigen::Vector3d way =
          along_normal ? Eigen::Vector3d (-0.3 * std::cos (0.1 * points[i].x ()), 0, 1)
                       : samples::normalVector (random);
      points.emplace_back (points[i] +
                           offset * (0.1 + 0.9 * random.uniform ()) * way.normalized ());
    }
  return points;
}

struct Chosen
{
  Points points;
  Stacks stacks;
};

Chosen
chosen (const Positions& cloud, int threads = 1)
{
  Chosen result{workingPoints (cloud), {}};
  CsrLists neighbors = findNeighbors (result.points, {}, threads);
  result.stacks = chooseNet (result.points, neighbors, {}, {}, threads, nullptr);
  EXPECT_EQ (neighbors.ids, findNeighbors (result.points, {}, threads).ids);
  return result;
}

TEST (Net, HasOnePointOfEachStackAtItsMean)
{
  for (const std::size_t copies : {1U, 3U, 9U})
    for (const double offset : {1e-9, 1e-4, 0.02, 0.08})
      for (const bool along_normal : {true, false}) {
        if (offset * static_cast<double> (copies) > 0.3)
          continue; // a stack may be wider than the gap
        SCOPED_TRACE (offset);
        const Positions cloud = stackedSheet (40, 1600, copies, offset, along_normal);
        const auto [points, stacks] = chosen (cloud);
        EXPECT_EQ (stacks.points, copies * 1600);
        EXPECT_EQ (points.size (), 1600U);
        EXPECT_EQ (points.total (), cloud.size ());
        EXPECT_GT (stacks.median, 0.05 * offset);
        EXPECT_LE (stacks.median, stacks.largest);
        EXPECT_LE (stacks.largest, 4.0 * offset);
        Positions sum (1600, Eigen::Vector3d::Zero ());
        for (Index p = 0; p < cloud.size (); ++p)
          sum[p % 1600] += cloud[p] / static_cast<double> (copies + 1);
        for (Index p = 0; p < points.size (); ++p) {
          const Index original = points.cloud_index[p];
          EXPECT_LT ((points.inCloud (p) - cloud[original]).norm (), 1e-9);
          EXPECT_LT (
              (points.centre + points.scale * points.positions[p] - sum[original % 1600]).norm (),
              1e-9);
        }
        const Points all = withStacked (points);
        for (Index p = 0; p < all.size (); ++p)
          EXPECT_LT ((all.inCloud (p) - cloud[all.cloud_index[p]]).norm (), 1e-9);
      }
}

TEST (Net, DependsOnNoOrderAndNoThreads)
{
  const Positions cloud = stackedSheet (50, 1800, 2, 0.15, false);
  const auto netOf = [] (const Positions& points, int threads) {
    Positions net = chosen (points, threads).points.positions;
    std::sort (net.begin (), net.end (), [] (const auto& a, const auto& b) {
      return std::lexicographical_compare (a.begin (), a.end (), b.begin (), b.end ());
    });
    return net;
  };
  const Positions net = netOf (cloud, 1);
  EXPECT_GT (net.size (), 2400U);
  EXPECT_LT (net.size (), 4000U);
  EXPECT_EQ (netOf (cloud, 4), net);
  Positions shuffled;
  for (const Index p : samples::permutation (cloud.size (), 3))
    shuffled.push_back (cloud[p]);
  EXPECT_EQ (netOf (shuffled, 1), net);
}

TEST (Net, IsNotForPointsThatLieSideBySide)
{
  Positions random = samples::randomPoints (20000, 2), lines;
  for (Eigen::Vector3d& p : random)
    p.z () = 0.0;
  for (int x = 0; x < 400; ++x)
    for (int y = 0; y < 20; ++y)
      lines.emplace_back (x + 0.7 * std::sin (9.0 * x + y), 30.0 * y, 0.0);
  for (const Positions& cloud :
       {random, lines, samples::surface (SurfaceKind::SPHERE, 5000, 0.3),
        samples::surface (SurfaceKind::HEMISPHERE, 5000, 0.0, 30.0),
        stackedSheet (40, 0, 0, 0, true), Positions{}, samples::randomPoints (3, 1),
        stackedSheet (6, 36, 1, 0.1, true), stackedSheet (1, 1, 5, 1e-9, true)}) {
    const auto [points, stacks] = chosen (cloud);
    EXPECT_EQ (stacks.points, 0U);
    EXPECT_EQ (points.size (), cloud.size ());
    EXPECT_TRUE (points.stacked.own.empty ());
  }
}

// Stacks in a part of the cloud, and single points that are equal but for rounding.
TEST (Net, IsChosenWherePointsAreStacked)
{
  for (const double offset : {0.05, 1e-7}) {
    Positions cloud = stackedSheet (200, 800, 1, offset, true);
    RandomStream random (4); // side by side by chance, at the other end
    for (std::size_t p = 30000; p < 30500; ++p)
      cloud.emplace_back (cloud[p] + Eigen::Vector3d (0.15 + 0.01 * random.uniform (), 0.05, 0));
    const auto [points, stacks] = chosen (cloud);
    EXPECT_EQ (stacks.points, 800U);
    for (const Index index : points.stacked.cloud_index)
      EXPECT_TRUE (index < 800 || (index >= 40000 && index < 40800)) << index;
  }
  Positions few = stackedSheet (200, 3, 1, 1e-6, true);
  EXPECT_EQ (chosen (few).stacks.points, 3U);
}

TEST (Net, PointsTakeTheirStackAlong)
{
  Points points = chosen (stackedSheet (40, 1600, 2, 0.05, true)).points;
  const Index carrier = points.stacked.of.front ();
  EXPECT_EQ (removePoints (points, {carrier}).size (), 3U);
  EXPECT_EQ (points.size (), 1599U);
  EXPECT_EQ (points.total (), 4797U);
  EXPECT_EQ (points.stacked.own.size (), 1599U);
  for (std::size_t i = 0; i < points.stacked.of.size (); ++i)
    EXPECT_LT (points.scale *
                   (points.stacked.positions[i] - points.stacked.own[points.stacked.of[i]]).norm (),
               0.11);
  Points near;
  near = chosen (stackedSheet (40, 1600, 2, 0.05, true)).points;
  removePoints (near, {[&] {
                  std::vector<Index> most = indices (near.size ());
                  most.erase (most.begin () + 20, most.begin () + 60);
                  return most;
                }()});
  EXPECT_EQ (near.total (), 120U); // scaled again, with their stacks
  for (std::size_t i = 0; i < near.stacked.of.size (); ++i)
    EXPECT_LT (near.scale *
                   (near.stacked.positions[i] - near.stacked.own[near.stacked.of[i]]).norm (),
               0.11);
}

} // namespace
} // namespace pcl::floater
