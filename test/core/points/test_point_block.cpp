// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points of a block. That searches do not depend on the number of blocks is in test_neighbors.cpp.
#include "points/point_block.h"

#include "points/point_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::surface;

TEST (BlockCutter, DealsOutEveryPointOnce)
{
  const Points points = samples::workingPoints (surface (SurfaceKind::SPHERE, 5000));
  for (const std::size_t count : {1U, 2U, 7U, 64U, 100000U}) {
    const BlockCutter cutter (points.positions, count, 2);
    EXPECT_LE (cutter.blocks (), count);
    EXPECT_EQ (cutter.first (0), 0U);
    EXPECT_EQ (cutter.last (cutter.blocks () - 1), points.size ());
    for (std::size_t i = 0; i < cutter.blocks (); ++i) {
      ASSERT_LT (cutter.first (i), cutter.last (i));
      const PointBlock block = cutter.cut (i, {});
      ASSERT_EQ (block.positions.size (), block.points.size ());
      for (std::size_t row = 0; row < block.points.size (); ++row) {
        ASSERT_EQ (block.positions[row], points.positions[block.points[row]]);
        ASSERT_TRUE (row == 0 || block.points[row - 1] < block.points[row]);
      }
      // The own points are consecutive, so all of them are there if their number is right.
      ASSERT_EQ (block.placeOf (cutter.last (i)) - block.placeOf (cutter.first (i)),
                 cutter.last (i) - cutter.first (i));
      if (cutter.blocks () == 1) {
        EXPECT_EQ (block.points.size (), points.size ());
      }
    }
  }
}

TEST (BlockCutter, PutsEveryPointOfHaloAndBallsIn)
{
  const Points points = samples::workingPoints (surface (SurfaceKind::TORUS, 20000));
  const BlockCutter cutter (points.positions, 9, 1);
  const std::vector<Ball> balls{{points.positions[17], 0.02},
                                {Eigen::Vector3d (0.3, 0.0, 0.0), 0.05}};
  for (std::size_t i = 0; i < cutter.blocks (); ++i) {
    const PointBlock block = cutter.cut (i, balls);
    ASSERT_GT (block.halo, 0.0);
    EXPECT_LT (block.positions.size (), points.size ());
    for (Index p = 0; p < points.size (); ++p) {
      bool is_wanted = false;
      for (const Ball& ball : balls)
        is_wanted = is_wanted || (points.positions[p] - ball.centre).norm () <= ball.radius;
      for (Index own = cutter.first (i); own < cutter.last (i) && !is_wanted; own += 8)
        is_wanted = (points.positions[p] - points.positions[own]).norm () <= block.halo;
      const bool is_there = std::binary_search (block.points.begin (), block.points.end (), p);
      ASSERT_TRUE (is_there || !is_wanted);
    }
  }
}

TEST (ChooseBlocks, ByPointsAndThreads)
{
  EXPECT_EQ (chooseBlocks (1000, 0, 2), 1U);
  EXPECT_EQ (chooseBlocks (262144, 0, 2), 1U);
  EXPECT_EQ (chooseBlocks (300000, 0, 2) % 2, 0U);
  EXPECT_EQ (chooseBlocks (300000, 0, 8), 8U);
  EXPECT_EQ (chooseBlocks (10000000, 0, 1), 77U);
  EXPECT_EQ (chooseBlocks (1000, 64, 2), 64U);
}

} // namespace
} // namespace pcl::floater
