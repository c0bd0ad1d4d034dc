// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/noise.h"

#include "points/neighbors.h"
#include "points/point_samples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pcl::floater {
namespace {
using samples::jitteredGrid;
using samples::joined;
using samples::normalVector;
using samples::placed;
using samples::Positions;
using samples::surface;

struct Cloud
{
  Points points;
  CsrLists neighbors;

  explicit Cloud (const Positions& positions)
      : points (samples::workingPoints (positions)),
        neighbors (findNearestNeighbors (points.positions, Rows::all (points.size ()), 20, 1))
  {
  }

  Noise noise () const { return measureNoise (points.positions, neighbors, {}, 1); }
  double share (std::size_t count) const
  {
    return static_cast<double> (count) / static_cast<double> (points.size ());
  }
  double noisyShare () const { return share (noise ().noisy_points); }
  Positions projected () const
  {
    return projectNoisyPoints (points.positions, neighbors, noise (), {}, 1);
  }
};

/// Factor by which projection changes the root mean square of a deviation.
template <typename Deviation>
double
changeByProjection (const Cloud& cloud, Deviation&& deviationAt)
{
  const Positions projected = cloud.projected ();
  double before = 0.0, after = 0.0;
  for (std::size_t p = 0; p < projected.size (); ++p) {
    const Points& points = cloud.points;
    before += std::pow (deviationAt (points.centre + points.scale * points.positions[p]), 2);
    after += std::pow (deviationAt (points.centre + points.scale * projected[p]), 2);
  }
  return std::sqrt (after / before);
}

TEST (Noise, TellsStrongNoiseFromNone)
{
  for (const auto& [name, kind] : SURFACES) {
    if (kind == SurfaceKind::FOLDED_SHEET)
      continue; // its flaps look like noise at the largest scale; see ThinSheetsAreNone
    SCOPED_TRACE (name);
    EXPECT_LT (Cloud (surface (kind, 6000, 0.0)).noisyShare (), 0.1);
    EXPECT_LT (Cloud (surface (kind, 6000, 0.1)).noisyShare (), 0.3);
    for (const double deviation : {0.3, 0.5}) {
      const Cloud cloud (surface (kind, 6000, deviation));
      EXPECT_GT (cloud.noisyShare (), 0.6);
      EXPECT_NEAR (cloud.noise ().median, deviation, 0.4 * deviation);
    }
  }
}

// Two chains of points; projection explains the first, and only moves the disagreement of the other.
TEST (Noise, IsKeptInRegionsThatItExplains)
{
  Noise noise;
  noise.at_point.assign (20, 1.0F);
  noise.at_point[0] = 0.0F;
  noise.noisy_points = 19;
  CsrLists chains;
  chains.offsets = {0};
  for (Index p = 0; p < 20; ++p) {
    if (p % 10 != 9)
      chains.ids.push_back (p + 1);
    chains.offsets.push_back (static_cast<Index> (chains.ids.size ()));
  }
  const std::vector<float> before (20, 0.8F);
  std::vector<float> after (20, 0.95F);
  std::fill (after.begin () + 10, after.end (), 0.85F);
  keepExplained (chains, before, after, {}, noise);
  EXPECT_EQ (noise.noisy_points, 9U);
  EXPECT_EQ (noise.at_point[9], 1.0F);
  EXPECT_EQ (noise.at_point[10], 0.0F);
}

TEST (Noise, ThinSheetsAreNone)
{
  for (const double gap : {1.5, 2.0, 3.0, 5.0}) {
    SCOPED_TRACE (gap);
    RandomStream random (4); // one over the other, their points not
    const Positions sheets =
        joined (jitteredGrid (60, 60, 1.0, 0.5, random),
                placed (jitteredGrid (60, 60, 1.0, 0.5, random), {0.0, 0.0, gap}));
    EXPECT_FALSE (reconstruct (samples::asInput (sheets), {}).report.denoised);
  }
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

// A slope whose heights are rounded to whole steps, 2.5 spacings apart: flat terraces. Of the standard
// deviation of a step, 0.29, at least half is gone.
TEST (Projection, QuantizedDepthIsNoise)
{
  RandomStream random (3);
  Positions terraces = jitteredGrid (80, 80, 1.0, 0.0, random);
  for (Eigen::Vector3d& p : terraces)
    p.z () = 2.5 * std::round ((0.4 * p.x () + 0.3 * random.normal ()) / 2.5);
  const Cloud cloud (terraces);
  EXPECT_GT (cloud.noisyShare (), 0.6);
  EXPECT_LT (
      changeByProjection (cloud, [] (const Eigen::Vector3d& p) { return p.z () - 0.4 * p.x (); }),
      0.5);
}

TEST (Projection, TakesMostOfTheNoiseOut)
{
  RandomStream random (5);
  Positions sphere = surface (SurfaceKind::SPHERE, 4000, 0.0);
  const double spacing = std::sqrt (4.0 * samples::PI / 4000.0);
  for (Eigen::Vector3d& p : sphere)
    p = p.normalized () + 0.4 * spacing * normalVector (random);
  EXPECT_LT (changeByProjection (Cloud (sphere),
                                 [] (const Eigen::Vector3d& p) { return p.norm () - 1.0; }),
             0.5);
}

TEST (Projection, AnotherSheetDoesNotPull)
{
  RandomStream random (2);
  Positions sheets; // 8 spacings apart, each with noise of 0.4
  for (const double z : {0.0, 8.0})
    for (const Eigen::Vector3d& p : jitteredGrid (50, 50, 1.0, 0.2, random))
      sheets.emplace_back (p.x (), p.y (), z + 0.4 * random.normal ());
  const Cloud cloud (sheets);
  EXPECT_GT (cloud.noisyShare (), 0.6);
  for (const Eigen::Vector3d& projected : cloud.projected ()) {
    const double z = (cloud.points.centre + cloud.points.scale * projected).z ();
    EXPECT_LT (std::min (std::abs (z), std::abs (z - 8.0)), 1.2);
  }
}

} // namespace
} // namespace pcl::floater
