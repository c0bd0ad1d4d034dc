// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/noise.h"

#include "points/neighbors.h"
#include "points/point_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Positions;
using samples::surface;

struct Cloud
{
  Points points;
  CsrLists neighbors;

  explicit Cloud (const Positions& positions, int k = 20)
      : points (makePoints (positions, samples::indices (positions.size ()), 1)),
        neighbors (findNearestNeighbors (points.positions, Rows::all (points.size ()), k, 1, 1))
  {
  }

  Noise noise (int threads = 1) const
  {
    return measureNoise (points.positions, neighbors, {}, threads);
  }
  double noisyShare () const
  {
    return static_cast<double> (noise ().noisy_points) / static_cast<double> (points.size ());
  }
  Positions projected (int threads = 1) const
  {
    return projectNoisyPoints (points.positions, neighbors, noise (threads), {}, threads);
  }
};

TEST (Noise, TellsStrongNoiseFromNone)
{
  for (const SurfaceKind kind : surfaceKinds ()) {
    if (kind == SurfaceKind::FOLDED_SHEET)
      continue; // its flaps look like noise at the largest scale; see ThinSheetsAreNone
    SCOPED_TRACE (surfaceName (kind));
    EXPECT_LT (Cloud (surface (kind, 6000, 0.0)).noisyShare (), 0.1);
    EXPECT_LT (Cloud (surface (kind, 6000, 0.1)).noisyShare (), 0.3);
    for (const double deviation : {0.3, 0.5}) {
      const Cloud cloud (surface (kind, 6000, deviation));
      EXPECT_GT (cloud.noisyShare (), 0.6);
      EXPECT_NEAR (cloud.noise ().median, deviation, 0.4 * deviation);
    }
  }
}

TEST (Noise, IsStrongWhereStarsOfNoisyPointsDisagree)
{
  const NoiseLimits limits;
  Noise noise;
  noise.at_point.assign (100, 0.0F);
  const std::vector<float> agreeing (100, 1.0F), disagreeing (100, 0.8F);
  EXPECT_FALSE (isStrong (noise, disagreeing, limits));
  const auto makeNoisy = [&noise] (std::size_t count) {
    std::fill_n (noise.at_point.begin (), count, 1.0F);
    noise.noisy_points = count;
  };
  makeNoisy (17);
  EXPECT_FALSE (isStrong (noise, disagreeing, limits));
  makeNoisy (18);
  EXPECT_TRUE (isStrong (noise, disagreeing, limits));
  makeNoisy (100);
  EXPECT_FALSE (isStrong (noise, agreeing, limits));
}

// A slope whose heights are rounded to whole steps, 2.5 spacings apart: flat terraces.
Positions
terraces ()
{
  RandomStream random (3);
  Positions positions;
  for (int x = 0; x < 80; ++x)
    for (int y = 0; y < 80; ++y) {
      const double height = 0.4 * x + 0.3 * random.normal ();
      positions.emplace_back (x, y, 2.5 * std::round (height / 2.5));
    }
  return positions;
}

TEST (Noise, QuantizedDepthIsNoise)
{
  const Cloud cloud (terraces ());
  EXPECT_GT (cloud.noisyShare (), 0.6);
  const Positions projected = cloud.projected ();
  // Of the standard deviation of a step, 0.29, at least half is gone.
  double before = 0.0, after = 0.0;
  for (std::size_t p = 0; p < projected.size (); ++p) {
    const auto off = [&cloud] (const Eigen::Vector3d& position) {
      const Eigen::Vector3d q = cloud.points.centre + cloud.points.scale * position;
      return q.z () - 0.4 * q.x ();
    };
    before += std::pow (off (cloud.points.positions[p]), 2);
    after += std::pow (off (projected[p]), 2);
  }
  EXPECT_LT (after, 0.25 * before);
}

TEST (Noise, ThinSheetsAreNone)
{
  for (const double gap : {1.5, 2.0, 3.0, 5.0}) {
    SCOPED_TRACE (gap);
    RandomStream random (4);
    Positions sheets; // one over the other, their points not
    for (int x = 0; x < 60; ++x)
      for (int y = 0; y < 60; ++y)
        for (const double z : {0.0, gap})
          sheets.emplace_back (x + 0.5 * random.uniform (), y + 0.5 * random.uniform (), z);
    EXPECT_FALSE (reconstruct (samples::asInput (sheets), {}).report.denoised);
  }
}

TEST (Noise, PointsWithoutNeighboursAreNotNoisy)
{
  Cloud cloud (surface (SurfaceKind::TORUS, 2000, 0.5));
  std::vector<Index>& offsets = cloud.neighbors.offsets; // as a caller's search may answer
  std::fill (offsets.begin () + 1, offsets.begin () + 100, 0U);
  const Noise noise = cloud.noise ();
  EXPECT_GT (noise.noisy_points, 1000U);
  EXPECT_EQ (noise.at_point[50], 0.0F);
  EXPECT_TRUE (std::isfinite (noise.largest));
  EXPECT_EQ (cloud.projected ()[50], cloud.points.positions[50]);
}

TEST (Noise, DegenerateClouds)
{
  EXPECT_EQ (measureNoise ({}, CsrLists (), {}, 1).noisy_points, 0U);
  EXPECT_TRUE (projectNoisyPoints ({}, {}, {}, {}, 1).empty ());
  for (const std::size_t count : {1U, 2U, 3U, 4U, 5U, 30U, 319U, 320U, 1000U}) {
    Positions line;
    for (std::size_t i = 0; i < count; ++i)
      line.emplace_back (static_cast<double> (i), 0.0, 0.0);
    EXPECT_EQ (Cloud (line).noise ().noisy_points, 0U);
    const Cloud cloud (samples::randomPoints (count, count));
    const Noise noise = cloud.noise ();
    EXPECT_TRUE (std::isfinite (noise.largest) && noise.median >= 0.0);
    for (const Eigen::Vector3d& p : cloud.projected ())
      EXPECT_TRUE (p.allFinite ());
  }
}

// Root mean square distance to the unit sphere.
double
offSphere (const Positions& positions, const Points& points)
{
  double sum = 0.0;
  for (const Eigen::Vector3d& p : positions) {
    const double off = (points.centre + points.scale * p).norm () - 1.0;
    sum += off * off;
  }
  return std::sqrt (sum / static_cast<double> (positions.size ()));
}

TEST (Projection, TakesMostOfTheNoiseOut)
{
  RandomStream random (5);
  Positions sphere = surface (SurfaceKind::SPHERE, 4000, 0.0);
  const double spacing = std::sqrt (4.0 * samples::PI / 4000.0);
  for (Eigen::Vector3d& p : sphere)
    p = p.normalized () +
        0.4 * spacing * Eigen::Vector3d (random.normal (), random.normal (), random.normal ());
  const Cloud cloud (sphere);
  EXPECT_LT (offSphere (cloud.projected (), cloud.points),
             0.5 * offSphere (cloud.points.positions, cloud.points));
  EXPECT_EQ (cloud.projected (3), cloud.projected (1));
}

TEST (Projection, AnotherSheetDoesNotPull)
{
  RandomStream random (2);
  Positions sheets; // 8 spacings apart, each with noise of 0.4
  for (int x = 0; x < 50; ++x)
    for (int y = 0; y < 50; ++y)
      for (const double z : {0.0, 8.0})
        sheets.emplace_back (x + 0.2 * random.uniform (), y, z + 0.4 * random.normal ());
  const Cloud cloud (sheets);
  EXPECT_GT (cloud.noisyShare (), 0.6);
  for (const Eigen::Vector3d& projected : cloud.projected ()) {
    const double z = (cloud.points.centre + cloud.points.scale * projected).z ();
    EXPECT_LT (std::min (std::abs (z), std::abs (z - 8.0)), 1.2);
  }
}

} // namespace
} // namespace pcl::floater
