// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The samples that other tests rely on have the density and size that they are meant to have.
#include "darts.h"
#include "surface_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater::samples {
namespace {
double
leastDistance (const Positions& points)
{
  double least = std::numeric_limits<double>::infinity ();
  for (std::size_t i = 0; i < points.size (); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least = std::min (least, (points[i] - points[j]).squaredNorm ());
  return std::sqrt (least);
}

TEST (SurfaceSamples, AreEvenWithOnePointForEachUnitOfArea)
{
  for (const KnownSurface& surface :
       {taco (3.0, 1), comb (5.0, false, 2), sheetWithHoles (9, 5.0, false, 3), annulus (4),
        sphereWithThreeHoles (5), parallelSheets (2.0, 6), box (true, 7), box (false, 8),
        bracket (9), cylinder (10)}) {
    const double count = static_cast<double> (surface.points.size ());
    EXPECT_GE (leastDistance (surface.points), 0.95 * DART_DISTANCE);
    EXPECT_GT (count / surface.area, 0.9);
    EXPECT_LT (count / surface.area, 1.25); // borders have more
  }
}

TEST (SurfaceSamples, LeaveNoGapInADisc)
{
  const KnownSurface surface = taco (5.0, 1);
  // The points of another sample are test places all over the surface.
  const KnownSurface other = taco (5.0, 3);
  for (const Eigen::Vector3d& p : other.points) {
    double nearest = std::numeric_limits<double>::infinity ();
    for (const Eigen::Vector3d& q : surface.points)
      nearest = std::min (nearest, (p - q).norm ());
    EXPECT_LT (nearest, 1.2);
  }
}

TEST (SurfaceSamples, DensityFallsAsAsked)
{
  for (const bool abrupt : {false, true}) {
    const KnownSurface surface = unevenSheet (30.0, abrupt, 1);
    // Around the cylinder of radius 80, from the dense border to the sparse one.
    const auto densityBetween = [&] (double from, double to) {
      double count = 0.0;
      for (const Eigen::Vector3d& p : surface.points) {
        const double x = 80.0 * std::asin (std::min (1.0, p.x () / 80.0));
        count += x > from && x < to && p.y () > 8.0 && p.y () < 72.0 ? 1.0 : 0.0;
      }
      return count / (64.0 * (to - from));
    };
    EXPECT_NEAR (densityBetween (2.0, 6.0), abrupt ? 1.0 : std::pow (30.0, -4.0 / 80.0), 0.15);
    EXPECT_NEAR (30.0 * densityBetween (60.0, 78.0), abrupt ? 1.0 : std::pow (30.0, 11.0 / 80.0),
                 0.4);
  }
}

TEST (SurfaceSamples, DoubleTorusIsOnItsSurface)
{
  const KnownSurface surface = doubleTorus (3);
  EXPECT_GE (leastDistance (surface.points), 0.999 * DART_DISTANCE);
  EXPECT_GT (surface.points.size (), 2000U);
  // Two holes: no point is near the middle of either.
  for (const Eigen::Vector3d& p : surface.points)
    EXPECT_GT (std::hypot (std::abs (p.x ()) - 26.0 * std::sqrt (0.5), p.y ()), 5.0);
}

TEST (SurfaceSamples, FlawedSamplesHaveTheirFlaw)
{
  const KnownSurface clean = annulus (1);
  const KnownSurface far = withOutliers (clean, 10, 4.0, 2);
  ASSERT_EQ (far.outliers.size (), 10U);
  for (const Index outlier : far.outliers)
    for (const Eigen::Vector3d& p : clean.points)
      EXPECT_GE ((p - far.points[outlier]).norm (), 4.0);
  const KnownSurface twice = withDuplicates (clean, 30, 3);
  EXPECT_EQ (twice.points.size (), clean.points.size () + 30);
  EXPECT_EQ (leastDistance (twice.points), 0.0);
  const KnownSurface noisy = withNoise (clean, 0.3, 4);
  double sum = 0.0;
  for (std::size_t i = 0; i < noisy.points.size (); ++i)
    sum += (noisy.points[i] - noisy.clean[i]).squaredNorm ();
  EXPECT_NEAR (std::sqrt (sum / 3.0 / static_cast<double> (noisy.points.size ())), 0.3, 0.01);
  const KnownSurface both = withComponent (clean, clean, 2.0, {100.0, 0.0, 0.0});
  EXPECT_EQ (both.loops, 4U);
  EXPECT_DOUBLE_EQ (both.area, 5.0 * clean.area);
  EXPECT_EQ (eulerOf (both), 0);
}

} // namespace
} // namespace pcl::floater::samples
