// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points of a block, and nearest neighbours that do not depend on the number of blocks.
#include "points/point_block.h"

#include "points/neighbors.h"
#include "points/point_samples.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Positions;
using samples::surface;
using samples::workingPoints;

constexpr int NEIGHBORS = 20;

/// Two tori, three small clusters far away, each of fewer points than a point has neighbours, and
/// single points at all distances: halos of an even width are too narrow.
Positions
scattered ()
{
  Positions points = surface (SurfaceKind::TORUS, 3000);
  for (const Eigen::Vector3d& p : surface (SurfaceKind::TORUS, 800))
    points.emplace_back (0.2 * p + Eigen::Vector3d (150.0, 0.0, 20.0));
  for (int cluster = 0; cluster < 3; ++cluster)
    for (const Eigen::Vector3d& p : samples::randomPoints (9, 7U + static_cast<unsigned> (cluster)))
      points.emplace_back (p + 300.0 * Eigen::Vector3d::Unit (cluster));
  for (int i = 1; i <= 12; ++i)
    points.emplace_back (100.0 * std::cos (i), 100.0 * std::sin (i), 3.0 * i * i);
  return points;
}

/// A sheet whose spacing is 1 up to a line and 20 beyond it.
Positions
abruptlySparse ()
{
  RandomStream random (12);
  Positions points;
  const auto addSide = [&] (double left, double spacing, int columns, int rows) {
    for (int x = 0; x < columns; ++x)
      for (int y = 0; y < rows; ++y) {
        const double dx = 0.3 * random.uniform (), dy = 0.3 * random.uniform ();
        points.emplace_back (left + spacing * (x + dx), spacing * (y + dy), 0.0);
      }
  };
  addSide (-30.0, 1.0, 30, 100);
  addSide (0.0, 20.0, 12, 30);
  return points;
}

CsrLists
neighborsIn (std::size_t blocks, const Points& points, int threads = 1)
{
  return findNearestNeighbors (points.positions, Rows::all (points.size ()), NEIGHBORS, blocks,
                               threads);
}

/// Counts points with a neighbour beyond the halo of their block. For these the block has to be cut
/// again, with a wider halo.
std::size_t
countPointsBeyondTheHalo (const Points& points, std::size_t blocks)
{
  const CsrLists neighbors = neighborsIn (1, points);
  const BlockCutter cutter (points.positions, blocks, 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < cutter.blocks (); ++i) {
    const PointBlock block = cutter.cut (i, {});
    for (Index p = cutter.first (i); p < cutter.last (i); ++p) {
      const Row row = neighbors.row (p);
      const Index farthest = row[row.size () - 1];
      count += (points.positions[farthest] - points.positions[p]).norm () > block.halo ? 1 : 0;
    }
  }
  return count;
}

TEST (BlockCutter, DealsOutEveryPointOnce)
{
  const Points points = workingPoints (surface (SurfaceKind::SPHERE, 5000));
  for (const std::size_t count : {1U, 2U, 7U, 64U, 100000U}) {
    const BlockCutter cutter (points.positions, count, 2);
    EXPECT_LE (cutter.blocks (), count);
    EXPECT_EQ (cutter.first (0), 0U);
    EXPECT_EQ (cutter.last (cutter.blocks () - 1), points.size ());
    for (std::size_t i = 0; i < cutter.blocks (); ++i) {
      ASSERT_LT (cutter.first (i), cutter.last (i));
      const PointBlock block = cutter.cut (i, {});
      ASSERT_EQ (block.positions.size (), block.points.size ());
      EXPECT_TRUE (std::is_sorted (block.points.begin (), block.points.end ()));
      for (std::size_t row = 0; row < block.points.size (); ++row)
        ASSERT_EQ (block.positions[row], points.positions[block.points[row]]);
      // The own points are consecutive, so all of them are there if their number is right.
      const auto first =
          std::lower_bound (block.points.begin (), block.points.end (), cutter.first (i));
      const auto last =
          std::lower_bound (block.points.begin (), block.points.end (), cutter.last (i));
      ASSERT_EQ (last - first, static_cast<std::ptrdiff_t> (cutter.last (i) - cutter.first (i)));
      EXPECT_EQ (std::adjacent_find (first, last), last);
      if (cutter.blocks () == 1) {
        EXPECT_EQ (block.points.size (), points.size ());
      }
    }
  }
}

TEST (BlockCutter, PutsEveryPointOfHaloAndBallsIn)
{
  const Points points = workingPoints (surface (SurfaceKind::TORUS, 20000));
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

// So the test of equal neighbours runs through blocks that are cut again.
TEST (BlockCutter, HalosOfUnevenCloudsAreTooNarrow)
{
  EXPECT_GT (countPointsBeyondTheHalo (workingPoints (scattered ()), 16), 0U);
  EXPECT_GT (countPointsBeyondTheHalo (workingPoints (abruptlySparse ()), 5), 0U);
}

TEST (Blocks, FindTheNeighborsOfTheWhole)
{
  const std::vector<Positions> clouds{surface (SurfaceKind::TORUS, 4000),
                                      surface (SurfaceKind::HEIGHT_FIELD, 4000, 0.0, 50.0),
                                      surface (SurfaceKind::FOLDED_SHEET, 3000),
                                      surface (SurfaceKind::SPHERE, 2000, 0.3),
                                      abruptlySparse (),
                                      scattered (),
                                      samples::randomPoints (700, 3),
                                      samples::randomPoints (30, 4)};
  for (std::size_t cloud = 0; cloud < clouds.size (); ++cloud) {
    const Points points = workingPoints (clouds[cloud]);
    const CsrLists whole = neighborsIn (1, points);
    for (const std::size_t blocks : {1U, 2U, 5U, 64U})
      for (const int threads : {1, 2}) {
        SCOPED_TRACE (testing::Message () << "cloud " << cloud << ", " << blocks << " blocks, "
                                          << threads << " threads");
        const CsrLists found = neighborsIn (blocks, points, threads);
        EXPECT_EQ (found.offsets, whole.offsets);
        EXPECT_EQ (found.ids, whole.ids);
      }
  }
}

TEST (Blocks, AreChosenByPointsAndThreads)
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
