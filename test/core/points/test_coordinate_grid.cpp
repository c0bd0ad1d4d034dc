// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/coordinate_grid.h"

#include "points/point_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::asInput;
using samples::ON_A_MAP;
using samples::placed;
using samples::Positions;
using samples::surface;

Positions
asFloats (Positions cloud)
{
  for (Eigen::Vector3d& p : cloud)
    for (double& value : p)
      value = static_cast<double> (static_cast<float> (value)); // GCC 12 leaves out two casts of p
  return cloud;
}

Positions
rounded (Positions cloud, double step)
{
  for (Eigen::Vector3d& p : cloud)
    p = step * (p / step).array ().round ().matrix ();
  return cloud;
}

// A raster of heights, of which some nodes are left out.
Positions
raster (double step, std::size_t one_in, const Eigen::Vector3d& place = {0, 0, 0})
{
  Positions cloud;
  RandomStream random (7);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x)
      if (random.below (one_in) == 0)
        cloud.emplace_back (place + Eigen::Vector3d (step * x, step * y, std::sin (0.1 * x * y)));
  return cloud;
}

CoordinateGrid
gridOf (const Positions& cloud)
{
  const samples::Neighborhoods made = samples::makeNeighborhoods (cloud);
  return findCoordinateGrid (made.points, made.geometry.spacing);
}

TEST (CoordinateGrid, MapCoordinatesInSinglePrecision)
{
  // With a spacing of about 1, times the scale.
  const Positions terrain = surface (SurfaceKind::HEIGHT_FIELD, 3000);
  for (const double scale : {0.3, 1.0, 3.0}) {
    const CoordinateGrid grid = gridOf (asFloats (placed (terrain, ON_A_MAP, scale)));
    EXPECT_EQ (grid.axis, 1);
    EXPECT_NEAR (grid.step, 0.5, 1e-6);
    EXPECT_GT (grid.spacings, 0.1);
    EXPECT_LT (grid.spacings, 2.0);
    EXPECT_TRUE (grid.is_single_precision);
  }
  // Fine enough for points further apart, and as doubles.
  EXPECT_EQ (gridOf (asFloats (placed (terrain, ON_A_MAP, 10.0))).step, 0.0);
  EXPECT_EQ (gridOf (placed (terrain, ON_A_MAP, 0.3)).step, 0.0);
  // Three axes with the same step, which is that of floats along all of them.
  const Eigen::Vector3d geocentric (4.2e6, 4.3e6, 5e6);
  const CoordinateGrid grid =
      gridOf (asFloats (placed (surface (SurfaceKind::TORUS, 3000), geocentric)));
  EXPECT_NEAR (grid.step, 0.5, 1e-6);
  EXPECT_TRUE (grid.is_single_precision);
}

TEST (CoordinateGrid, CoordinatesWithFewDigits)
{
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Positions torus = placed (surface (SurfaceKind::TORUS, 3000), {0, 0, 0}, scale);
    const CoordinateGrid grid = gridOf (rounded (torus, 0.2 * scale));
    EXPECT_NEAR (grid.step / scale, 0.2, 1e-6);
    EXPECT_GT (grid.spacings, 0.1);
    EXPECT_LT (grid.spacings, 0.4);
    EXPECT_FALSE (grid.is_single_precision);
    // So coarse that many points coincide.
    EXPECT_NEAR (gridOf (rounded (torus, 1.5 * scale)).step / scale, 1.5, 1e-5);
    EXPECT_EQ (gridOf (rounded (torus, 0.05 * scale)).step, 0.0);
    EXPECT_EQ (gridOf (torus).step, 0.0);
  }
}

TEST (CoordinateGrid, ARasterIsNoFlaw)
{
  for (const std::size_t one_in : {1U, 2U, 10U})
    for (const double step : {1.0, 0.1, 30.0}) {
      EXPECT_EQ (gridOf (raster (step, one_in)).step, 0.0);
      EXPECT_EQ (gridOf (asFloats (raster (step, one_in))).step, 0.0);
    }
  for (const double step : {1.0, 0.5}) // half is the step of floats there
    EXPECT_EQ (gridOf (asFloats (raster (step, 1, ON_A_MAP))).step, 0.0);
  // Flat ones, and voxels of a solid's surface.
  EXPECT_EQ (gridOf (samples::disc (0.05, 1).positions).step, 0.0);
  Positions voxels;
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 12; ++y)
      for (int z = 0; z < 12; ++z)
        if (x % 11 == 0 || y % 11 == 0 || z % 11 == 0)
          voxels.emplace_back (x, y, z);
  EXPECT_EQ (gridOf (voxels).step, 0.0);
}

TEST (CoordinateGrid, TheReportWarns)
{
  const Positions fine = placed (surface (SurfaceKind::HEIGHT_FIELD, 3000), ON_A_MAP, 0.3);
  const Result clean = reconstruct (asInput (fine), {});
  EXPECT_EQ (clean.report.statistics.coordinate_step, 0.0);
  EXPECT_TRUE (clean.report.warnings.empty ()) << clean.report.warnings.front ();
  const Result result = reconstruct (asInput (asFloats (fine)), {});
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  EXPECT_GT (result.report.statistics.coordinate_step, 0.1);
  std::string warnings; // rounding to wide steps looks like noise, too
  for (const std::string& warning : result.report.warnings)
    warnings += warning + "\n";
  for (const char* const text :
       {"the coordinates are coarse: along y they are 0.5 apart, ", "subtract an origin"})
    EXPECT_NE (warnings.find (text), std::string::npos) << warnings;
}

} // namespace
} // namespace pcl::floater
