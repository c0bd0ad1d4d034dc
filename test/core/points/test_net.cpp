// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The net of clouds whose points lie on one another; noise, and points that are projected.
#include "points/net.h"

#include "points/neighbors.h"
#include "points/noise.h"
#include "surface_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

// A jittered sheet of `side` x `side` points a unit apart, and copies of its first points, up to
// `offset` away.
Positions
stackedSheet (int side, std::size_t stacked, std::size_t copies, double offset, bool along_normal)
{
  RandomStream random (7);
  Positions points = jitteredGrid (side, side, 1.0, 0.4, random);
  for (Eigen::Vector3d& p : points)
    p.z () = 3.0 * std::sin (0.1 * p.x ());
  const std::size_t n = points.size ();
  for (std::size_t c = 0; c < copies; ++c)
    for (std::size_t i = 0; i < std::min (stacked, n); ++i) {
      const Eigen::Vector3d way =
          along_normal ? Eigen::Vector3d (-0.3 * std::cos (0.1 * points[i].x ()), 0, 1)
                       : normalVector (random);
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
chosen (const Positions& cloud)
{
  Chosen result{workingPoints (cloud), {}};
  CsrLists neighbors = findNeighbors (result.points, {}, 1);
  result.stacks = chooseNet (result.points, neighbors, {}, 1, nullptr);
  EXPECT_EQ (neighbors.ids, findNeighbors (result.points, {}, 1).ids);
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

TEST (Net, IsNotForPointsThatLieSideBySide)
{
  Positions random = randomPoints (20000, 2), lines;
  for (Eigen::Vector3d& p : random)
    p.z () = 0.0;
  for (int x = 0; x < 400; ++x)
    for (int y = 0; y < 20; ++y)
      lines.emplace_back (x + 0.7 * std::sin (9.0 * x + y), 30.0 * y, 0.0);
  for (const Positions& cloud :
       {random, lines, surface (SurfaceKind::SPHERE, 5000, 0.3),
        surface (SurfaceKind::HEMISPHERE, 5000, 0.0, 30.0), stackedSheet (40, 0, 0, 0, true),
        Positions{}, randomPoints (3, 1), stackedSheet (6, 36, 1, 0.1, true),
        stackedSheet (1, 1, 5, 1e-9, true)}) {
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
  const Points whole = chosen (stackedSheet (40, 1600, 2, 0.05, true)).points;
  std::vector<Index> most = indices (whole.size ()); // all but a few, which are scaled again
  most.erase (most.begin () + 20, most.begin () + 60);
  for (const std::vector<Index>& removed : {std::vector<Index>{whole.stacked.of.front ()}, most}) {
    Points points = whole;
    EXPECT_EQ (removePoints (points, removed).size (), 3 * removed.size ());
    EXPECT_EQ (points.size (), 1600 - removed.size ());
    EXPECT_EQ (points.total (), 3 * points.size ());
    const StackedPoints& stacked = points.stacked;
    EXPECT_EQ (stacked.own.size (), points.size ());
    for (std::size_t i = 0; i < stacked.of.size (); ++i)
      EXPECT_LT (points.scale * (stacked.positions[i] - stacked.own[stacked.of[i]]).norm (), 0.11);
  }
}

struct Cloud
{
  Points points;
  CsrLists neighbors;

  explicit Cloud (const Positions& positions)
      : points (workingPoints (positions)), neighbors (nearestOf (points.positions, 20))
  {
  }

  Noise noise () const { return measureNoise (points.positions, neighbors, 1); }
  double share (std::size_t count) const
  {
    return static_cast<double> (count) / static_cast<double> (points.size ());
  }
  double noisyShare () const { return share (noise ().noisy_points); }
  Positions projected () const
  {
    return projectNoisyPoints (points.positions, neighbors, noise (), 1);
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
  const CsrLists chains = makeCsrLists (20, [] (auto&& emit) {
    for (Index p = 0; p < 20; ++p)
      if (p % 10 != 9)
        emit (p, p + 1);
  });
  const std::vector<float> before (20, 0.8F);
  std::vector<float> after (20, 0.95F);
  std::fill (after.begin () + 10, after.end (), 0.85F);
  keepExplained (chains, before, after, noise);
  EXPECT_EQ (noise.noisy_points, 9U);
  EXPECT_EQ (noise.at_point[9], 1.0F);
  EXPECT_EQ (noise.at_point[10], 0.0F);
}

TEST (Noise, ThinSheetsAreNone)
{
  for (const double gap : {1.5, 2.0, 3.0, 5.0}) {
    SCOPED_TRACE (gap);
    EXPECT_FALSE (reconstruct (asInput (parallelSheets (gap, 4).points), {}).report.denoised);
  }
}

TEST (Noise, DegenerateClouds)
{
  EXPECT_EQ (measureNoise ({}, CsrLists (), 1).noisy_points, 0U);
  EXPECT_TRUE (projectNoisyPoints ({}, {}, {}, 1).empty ());
  for (const std::size_t count : {1U, 2U, 3U, 4U, 5U, 30U, 319U, 320U, 1000U}) {
    Positions line;
    for (std::size_t i = 0; i < count; ++i)
      line.emplace_back (static_cast<double> (i), 0.0, 0.0);
    EXPECT_EQ (Cloud (line).noise ().noisy_points, 0U);
    const Cloud cloud (randomPoints (count, count));
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
  const double spacing = std::sqrt (4.0 * PI / 4000.0);
  for (Eigen::Vector3d& p : sphere)
    p = p.normalized () + 0.4 * spacing * normalVector (random);
  EXPECT_LT (changeByProjection (Cloud (sphere),
                                 [] (const Eigen::Vector3d& p) { return p.norm () - 1.0; }),
             0.5);
}

TEST (Projection, AnotherSheetDoesNotPull)
{
  const Cloud cloud (withNoise (parallelSheets (8.0, 2), 0.4, 3).points);
  EXPECT_GT (cloud.noisyShare (), 0.6);
  for (const Eigen::Vector3d& projected : cloud.projected ()) {
    const double z = (cloud.points.centre + cloud.points.scale * projected).z ();
    EXPECT_LT (std::min (std::abs (z), std::abs (z - 8.0)), 1.2);
  }
}

} // namespace
} // namespace pcl::floater
