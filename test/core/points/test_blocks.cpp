// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks: what they hold, and that what comes out of them is what comes out of the whole.
#include "points/block_driver.h"

#include "points/nearest_neighbors.h"
#include "points/noise.h"
#include "samples.h"
#include "surfaces.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

#include <tuple>

namespace pcl
{
namespace floater
{
namespace
{
using samples::Positions;

constexpr int K = 20;

Positions
surface (SurfaceKind kind, std::size_t points, double density_ratio = 1.0, double noise = 0.0)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  spec.density_ratio = density_ratio;
  spec.noise = noise;
  return generateSurface (spec);
}

/// Two tori, three small clusters far away and apart, each of fewer points than have neighbours,
/// and single points at all distances: halos of an even width are too narrow.
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

Points
setOf (const Positions& positions)
{
  return makePoints (positions, samples::indices (positions.size ()), 1);
}

using CandidateKey = std::tuple<Triangle, int, int, float, float>;

std::vector<CandidateKey>
keysOf (const std::vector<CandidateLists>& candidates)
{
  std::vector<CandidateKey> keys;
  for (const CandidateLists& lists : candidates) {
    for (const SureTriangle& t : lists.sure)
      keys.emplace_back (t.corners, 4, t.clockwise, static_cast<float> (t.rank), 0.0F);
    for (const Candidate& t : lists.doubtful)
      keys.emplace_back (t.corners, t.votes, t.clockwise, t.size, t.agreement);
  }
  return keys;
}

void
expectSame (const CloudSurface& blocks, const BlockSurface& whole, const CsrLists& neighbors)
{
  EXPECT_EQ (blocks.neighbors.offsets, neighbors.offsets);
  EXPECT_EQ (blocks.neighbors.ids, neighbors.ids);
  EXPECT_EQ (blocks.spacing, whole.spacing);
  EXPECT_EQ (blocks.normals, whole.normals);
  EXPECT_EQ (blocks.smoothed_normals, whole.smoothed_normals);
  std::vector<CandidateKey> found = keysOf (blocks.candidates);
  std::vector<CandidateKey> wanted = keysOf ({whole.candidates});
  std::sort (found.begin (), found.end ());
  std::sort (wanted.begin (), wanted.end ());
  EXPECT_EQ (found, wanted);
}

TEST (BlockCutter, DealsOutEveryPointOnce)
{
  const Points set = setOf (surface (SurfaceKind::SPHERE, 5000));
  for (const std::size_t count : {1U, 2U, 7U, 64U, 100000U}) {
    const BlockCutter cutter (points.positions, count, 2);
    EXPECT_LE (cutter.blocks (), count);
    EXPECT_EQ (cutter.first (0), 0U);
    EXPECT_EQ (cutter.last (cutter.blocks () - 1), points.positions.size ());
    for (std::size_t i = 0; i < cutter.blocks (); ++i) {
      const PointBlock block = cutter.cut (i, {});
      ASSERT_GT (block.ownPoints (), 0U);
      ASSERT_EQ (block.ownPoints (), cutter.last (i) - cutter.first (i));
      EXPECT_EQ (block.point (block.first), cutter.first (i));
      for (Index row = 0; row < block.positions.size (); ++row)
        ASSERT_EQ (block.positions[row], points.positions[block.point (row)]);
      EXPECT_EQ (block.is_all, cutter.blocks () == 1);
    }
  }
}

TEST (BlockCutter, PutsEveryPointOfHaloAndBallsIn)
{
  const Points set = setOf (surface (SurfaceKind::TORUS, 20000));
  const BlockCutter cutter (points.positions, 9, 1);
  const std::vector<Ball> balls{{points.positions[17], 0.02},
                                {Eigen::Vector3d (0.3, 0.0, 0.0), 0.05}};
  for (std::size_t i = 0; i < cutter.blocks (); ++i) {
    const PointBlock block = cutter.cut (i, balls);
    ASSERT_GT (block.halo, 0.0);
    EXPECT_LT (block.positions.size (), points.positions.size ());
    for (Index p = 0; p < points.positions.size (); ++p) {
      bool is_wanted = false;
      for (const Ball& ball : balls)
        is_wanted = is_wanted || (points.positions[p] - ball.centre).norm () <= ball.radius;
      for (Index row = block.first; row < block.last && !is_wanted; row += 8)
        is_wanted = (points.positions[p] - block.positions[row]).norm () <= block.halo;
      const bool is_there = std::binary_search (block.points.begin (), block.points.end (), p);
      ASSERT_TRUE (is_there || !is_wanted);
    }
  }
}

TEST (Blocks, TellOfTheirNeighborhoodsWhatTheWholeTells)
{
  const std::vector<Positions> clouds{surface (SurfaceKind::TORUS, 4000),
                                      surface (SurfaceKind::HEIGHT_FIELD, 4000, 50.0),
                                      surface (SurfaceKind::FOLDED_SHEET, 3000),
                                      surface (SurfaceKind::SPHERE, 2000, 1.0, 0.3),
                                      scattered (),
                                      samples::randomPoints (700, 3),
                                      samples::randomPoints (30, 4)};
  for (std::size_t cloud = 0; cloud < clouds.size (); ++cloud) {
    const Points set = setOf (clouds[cloud]);
    const CsrLists neighbors = findNearestNeighbors (set, K, nullptr, 1);
    const BlockSurface whole = makeWholeSurface (points.positions, neighbors, true, 1);
    for (const std::size_t blocks : {1U, 2U, 5U, 64U})
      for (const int threads : {1, 2}) {
        SCOPED_TRACE (testing::Message ()
                      << "cloud " << cloud << ", " << blocks << " blocks, " << threads);
        Options options;
        options.threads = threads;
        ThreadDriver driver (threads);
        expectSame (makeCloudSurface (points.positions, blocks, options, driver), whole, neighbors);
      }
  }
}

/// Hands every block over as a copy of its own, last first, as one that sends them away would.
class DistantDriver : public BlockDriver
{
public:
  void run (std::size_t blocks, const Cut& cut, const Step& step, const Join& join) override
  {
    for (std::size_t block = blocks; block-- > 0;) {
      const Cut copy = [&] (std::size_t i, const std::vector<Ball>& balls) {
        tries += 1;
        const PointBlock original = cut (i, balls);
        most_points = std::max (most_points, original.positions.size ());
        return PointBlock (original);
      };
      join (block, surfaceOf (block, copy, step));
    }
  }
  std::size_t tries = 0, most_points = 0;
};

TEST (Blocks, AreWorkedOnByAnyDriver)
{
  const Points set = setOf (surface (SurfaceKind::TORUS, 20000));
  const CsrLists neighbors = findNearestNeighbors (set, K, nullptr, 1);
  DistantDriver driver;
  const CloudSurface blocks = makeCloudSurface (points.positions, 8, Options (), driver);
  expectSame (blocks, makeWholeSurface (points.positions, neighbors, true, 1), neighbors);
  EXPECT_EQ (driver.tries, 8U) << "a halo of an even surface is wide enough at once";
  EXPECT_LT (driver.most_points, 12000U);
}

TEST (Blocks, AreCutAgainWhereHalosAreTooNarrow)
{
  const Points set = setOf (scattered ());
  DistantDriver driver;
  makeCloudSurface (points.positions, 16, Options (), driver);
  EXPECT_GT (driver.tries, 16U);
}

TEST (Blocks, ErrorsInAStepComeOut)
{
  const Points set = setOf (surface (SurfaceKind::SPHERE, 2000));
  const BlockCutter cutter (points.positions, 8, 1);
  ThreadDriver driver (2);
  EXPECT_THROW (
      driver.run (
          8, [&] (std::size_t i, const std::vector<Ball>& balls) { return cutter.cut (i, balls); },
          [] (const PointBlock&) -> BlockSurface { throw std::bad_alloc (); },
          [] (std::size_t, const BlockSurface&) {}),
      std::bad_alloc);
}

TEST (Blocks, GiveTheSameMeshHoweverManyThereAre)
{
  Positions with_outliers = surface (SurfaceKind::HEIGHT_FIELD, 4000);
  with_outliers.emplace_back (0.0, 0.0, 40.0);
  with_outliers.emplace_back (9.0, 9.0, -60.0);
  const std::vector<Positions> clouds{surface (SurfaceKind::TORUS, 4000),
                                      surface (SurfaceKind::FOLDED_SHEET, 4000),
                                      surface (SurfaceKind::CUT_OUT, 4000),
                                      surface (SurfaceKind::SPHERE, 3000, 1.0, 0.3), with_outliers};
  for (std::size_t cloud = 0; cloud < clouds.size (); ++cloud) {
    Options options;
    options.topology = Topology::SURFACE;
    options.blocks = 1;
    const Result whole = reconstruct (samples::asInput (clouds[cloud]), options);
    ASSERT_EQ (whole.report.status, Status::OK) << whole.report.message;
    EXPECT_EQ (whole.report.denoised, cloud == 3);
    EXPECT_EQ (whole.report.outliers.size (), cloud == 4 ? 2U : 0U);
    for (const int blocks : {2, 64})
      for (const int threads : {1, 2}) {
        options.blocks = blocks;
        options.threads = threads;
        const Result result = reconstruct (samples::asInput (clouds[cloud]), options);
        EXPECT_EQ (result.triangles, whole.triangles) << "cloud " << cloud;
        EXPECT_EQ (result.report.warnings, whole.report.warnings);
        EXPECT_EQ (result.report.outliers, whole.report.outliers);
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
} // namespace floater
} // namespace pcl
