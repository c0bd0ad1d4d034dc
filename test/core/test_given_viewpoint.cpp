// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A viewpoint that the user gives, right and wrong, of scans of a scene.
#include "scan_samples.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace pcl::floater {
namespace {
using samples::Positions;
using samples::Raster;
using samples::Scan;

Result
seenFrom (const Positions& points, const Eigen::Vector3d& viewpoint, const Input& other = {})
{
  Input input = other;
  input.positions = points;
  input.cloud_index = samples::indices (points.size ());
  input.cloud_size = points.size ();
  Options options;
  options.view.use = ViewUse::GIVEN;
  options.view.viewpoint = {viewpoint.x (), viewpoint.y (), viewpoint.z ()};
  return reconstruct (std::move (input), options);
}

bool
isDoubted (const Result& result)
{
  EXPECT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  EXPECT_TRUE (result.report.is_view);
  const std::vector<std::string>& warnings = result.report.warnings;
  return std::any_of (warnings.begin (), warnings.end (), [] (const std::string& warning) {
    return warning.find ("not as seen from the given viewpoint") != std::string::npos;
  });
}

// A place beside the sensor, in a random direction, at a distance in box diagonals.
Eigen::Vector3d
besideSensor (const Scan& scan, double distance, std::uint64_t seed)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : scan.points)
    box.extend (p);
  std::mt19937_64 random (seed);
  std::normal_distribution<double> normal;
  const Eigen::Vector3d direction (normal (random), normal (random), normal (random));
  return scan.viewpoint + distance * box.diagonal ().norm () * direction.normalized ();
}

TEST (GivenViewpoint, TheRightOneIsNotDoubted)
{
  for (const Raster raster : {Raster::CAMERA, Raster::RINGS, Raster::SPHERE})
    for (const double noise : {0.0, 0.002, 0.005})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Scan scan = samples::scanScene (raster, {noise, 0.0}, seed);
        EXPECT_FALSE (isDoubted (seenFrom (scan.points, scan.viewpoint))) << noise << " " << seed;
      }
}

// Whoever thins a scan at random knows its viewpoint better than its points tell.
TEST (GivenViewpoint, TheRightOneOfAThinnedScanIsNotDoubted)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Scan scan = samples::scanScene (Raster::CAMERA, {0.002, 0.0}, seed);
    std::mt19937_64 random (seed);
    Positions half;
    for (const Eigen::Vector3d& p : scan.points)
      if (random () % 2 == 0)
        half.push_back (p);
    EXPECT_FALSE (isDoubted (seenFrom (half, scan.viewpoint))) << seed;
  }
}

TEST (GivenViewpoint, AWrongOneIsTold)
{
  int told = 0, given = 0;
  for (const Raster raster : {Raster::CAMERA, Raster::RINGS, Raster::SPHERE})
    for (const double distance : {0.1, 1.0})
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        const Scan scan = samples::scanScene (raster, {0.002, 0.0}, seed);
        ++given;
        told += isDoubted (seenFrom (scan.points, besideSensor (scan, distance, seed))) ? 1 : 0;
      }
  // It is not told where no other place is found: scans of 20,000 points are small.
  EXPECT_GE (4 * told, 3 * given) << "of " << given;
}

TEST (GivenViewpoint, TheOriginOfTheFileTellsThatAnotherOneIsWrong)
{
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Scan scan = samples::scanScene (Raster::CAMERA, {0.002, 0.0}, seed);
    Input input;
    input.sensor_origin = {scan.viewpoint.x (), scan.viewpoint.y (), scan.viewpoint.z ()};
    const Result result = seenFrom (scan.points, besideSensor (scan, 0.3, seed), input);
    EXPECT_TRUE (isDoubted (result)) << seed;
    EXPECT_FALSE (isDoubted (seenFrom (scan.points, scan.viewpoint, input))) << seed;
  }
}

} // namespace
} // namespace pcl::floater
