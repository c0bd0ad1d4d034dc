// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether points lie in rows, and in which planes: lines and circles, and a surface without rows.
#include "view/ray_evidence.h"

#include "points/neighbors.h"
#include "points/points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace pcl::floater {
namespace {
constexpr std::size_t SAMPLES = 200;

Points
pointsAt (const std::vector<Eigen::Vector3d>& positions)
{
  std::vector<Index> all (positions.size ());
  std::iota (all.begin (), all.end (), Index{0});
  return makePoints (positions, all, 1);
}

RowEvidence
rowsOf (const std::vector<Eigen::Vector3d>& positions)
{
  const Points points = pointsAt (positions);
  return findRows (points, findNeighbors (points, {}, 1), SAMPLES, 1);
}

// 20 rows of 200 points, which are ten times as near to each other as the rows.
std::vector<Eigen::Vector3d>
lines ()
{
  std::vector<Eigen::Vector3d> positions;
  for (int row = 0; row < 20; ++row)
    for (int i = 0; i < 200; ++i)
      positions.emplace_back (i, 10.0 * row, 0.02 * row * i);
  return positions;
}

// Sections of a cylinder along z.
std::vector<Eigen::Vector3d>
circles ()
{
  std::vector<Eigen::Vector3d> positions;
  for (int row = 0; row < 20; ++row)
    for (int i = 0; i < 200; ++i)
      positions.emplace_back (40.0 * std::cos (i * 0.0314), 40.0 * std::sin (i * 0.0314),
                              12.0 * row);
  return positions;
}

TEST (RowEvidence, LinesAreStraightRows)
{
  const RowEvidence rows = rowsOf (lines ());
  EXPECT_GT (rows.share, 0.95);
  EXPECT_TRUE (rows.are_straight);
}

TEST (RowEvidence, CirclesTellTheirPlanes)
{
  const RowEvidence rows = rowsOf (circles ());
  EXPECT_GT (rows.share, 0.95);
  EXPECT_FALSE (rows.are_straight);
  EXPECT_GT (std::abs (rows.across.z ()), 0.999);
}

TEST (RowEvidence, RandomPointsOfAPlaneHaveNoRows)
{
  std::mt19937 random (385);
  std::uniform_real_distribution<double> uniform (0.0, 1.0);
  std::vector<Eigen::Vector3d> positions;
  for (int i = 0; i < 4000; ++i)
    positions.emplace_back (uniform (random), uniform (random), 0.0);
  // By chance, the second neighbour lies opposite to the first one in a quarter of all directions.
  EXPECT_LT (rowsOf (positions).share, 0.5);
}

// A sample touches memory that no other does, so that a limit on it has to be watched.
TEST (RowEvidence, EachSampleIsATask)
{
  const Points points = pointsAt (circles ());
  const CsrLists neighbors = findNeighbors (points, {}, 1);
  Statistics statistics;
  std::size_t tasks = 0;
  RunMonitor monitor ({{}, {}, {}, [&tasks] { ++tasks; }}, statistics);
  findRows (points, neighbors, SAMPLES, RunContext (1, &monitor));
  EXPECT_EQ (tasks, SAMPLES);
}

} // namespace
} // namespace pcl::floater
