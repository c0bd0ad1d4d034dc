// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/outliers.h"

#include "points/neighbors.h"
#include "points/point_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Positions;
using samples::surface;

// The outliers in cloud indices.
std::vector<Index>
outliersOf (const Positions& positions, int k = 20, int threads = 1)
{
  Points points = makePoints (positions, samples::indices (positions.size ()), threads);
  const CsrLists neighbors =
      findNearestNeighbors (points.positions, Rows::all (points.size ()), k, 1, threads);
  return removePoints (points, findOutliers (points.positions, neighbors, threads));
}

// A square of `side` by `side` points, about 1 apart.
Positions
square (int side, double jitter, std::uint64_t seed)
{
  RandomStream random (seed);
  Positions points;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      points.emplace_back (x + jitter * random.uniform (), y + jitter * random.uniform (), 0.0);
  return points;
}

// A round lump of points about 0.3 from its centre.
void
addLump (Positions& positions, const Eigen::Vector3d& centre, std::size_t count,
         RandomStream& random)
{
  for (std::size_t i = 0; i < count; ++i)
    positions.emplace_back (
        centre + 0.3 * Eigen::Vector3d (random.normal (), random.normal (), random.normal ()));
}

std::vector<Index>
lastOf (const Positions& positions, std::size_t count)
{
  const std::vector<Index> all = samples::indices (positions.size ());
  return {all.end () - static_cast<std::ptrdiff_t> (count), all.end ()};
}

TEST (Outliers, NoneOnSurfaces)
{
  for (const SurfaceKind kind : surfaceKinds ())
    for (const double noise : {0.0, 0.1, 0.5}) {
      SCOPED_TRACE (surfaceName (kind) + std::string (", noise ") + std::to_string (noise));
      EXPECT_TRUE (outliersOf (surface (kind, 4000, noise)).empty ());
      EXPECT_TRUE (outliersOf (surface (kind, 4000, std::min (noise, 0.2), 30.0)).empty ());
    }
}

// A dense side and a sparse side, in one plane, or with the sparse side upright on the border of
// the dense one. Then its lowest points have neighbours on the dense side only.
TEST (Outliers, NoneWhereTheDensityChangesAbruptly)
{
  for (const double ratio : {3.0, 5.5, 15.0})
    for (const bool upright : {false, true})
      for (const double jitter : {0.0, 0.3}) {
        SCOPED_TRACE (testing::Message () << ratio << ' ' << upright << ' ' << jitter);
        RandomStream random (3);
        Positions points;
        for (int x = 1; x < 30; ++x)
          for (int y = 0; y < 90; ++y)
            points.emplace_back (-x + jitter * random.uniform (), y + jitter * random.uniform (),
                                 0.0);
        for (int x = 1; x < 8; ++x)
          for (int y = 0; y * ratio < 90.0; ++y) {
            const double away = ratio * (x + jitter * random.uniform ());
            const double along = ratio * (y + jitter * random.uniform ());
            points.emplace_back (upright ? 0.0 : away, along, upright ? away : 0.0);
          }
        EXPECT_TRUE (outliersOf (points).empty ());
      }
}

TEST (Outliers, NoneOnConesAndCubes)
{
  Positions cones;
  for (int x = 0; x < 60; ++x)
    for (int y = 0; y < 60; ++y)
      cones.emplace_back (x, y, std::max (0.0, 6.0 - 2.0 * std::hypot (x % 20 - 10, y % 20 - 10)));
  EXPECT_TRUE (outliersOf (cones).empty ());
  Positions cube;
  for (int x = 0; x <= 5; ++x)
    for (int y = 0; y <= 5; ++y)
      for (int z = 0; z <= 5; ++z)
        if (x % 5 == 0 || y % 5 == 0 || z % 5 == 0)
          cube.emplace_back (x, y, z);
  EXPECT_TRUE (outliersOf (cube).empty ());
}

TEST (Outliers, FlyingPixels)
{
  Positions points = square (60, 0.4, 1);
  RandomStream random (7);
  std::size_t flying = 0;
  for (int x = 5; x < 60; x += 10)
    for (int y = 5; y < 60; y += 10, ++flying)
      points.emplace_back (x + random.uniform (), y + random.uniform (),
                           (flying % 2 == 0 ? 1.0 : -1.0) * (3.5 + 3.0 * random.uniform ()));
  EXPECT_EQ (outliersOf (points), lastOf (points, flying));
  EXPECT_EQ (outliersOf (points, 20, 3), lastOf (points, flying));
  EXPECT_EQ (outliersOf (points, 30), lastOf (points, flying));
  // The points of a whole second sheet at that height are no outliers.
  const Positions other = square (60, 0.4, 2);
  for (const Eigen::Vector3d& p : other)
    points.emplace_back (p + Eigen::Vector3d (0.0, 0.0, 2.5));
  for (const Index p : outliersOf (points))
    EXPECT_LT (p, points.size () - other.size ());
}

TEST (Outliers, SmallClustersFarAway)
{
  for (const std::size_t count : {1U, 2U, 4U, 7U}) {
    SCOPED_TRACE (count);
    RandomStream random (count);
    Positions points = square (50, 0.4, 1);
    addLump (points, {25.0, 25.0, 20.0}, count, random);
    addLump (points, {80.0, 25.0, 0.0}, count, random); // in the plane of the sheet
    addLump (points, {-500.0, -300.0, 0.0}, count, random);
    EXPECT_EQ (outliersOf (points), lastOf (points, 3 * count));
  }
}

TEST (Outliers, SmallComponentsStay)
{
  for (const std::size_t count : {10U, 15U, 20U})
    for (const double size : {1.0, 10.0, 100.0}) {
      SCOPED_TRACE (testing::Message () << count << ' ' << size);
      Positions points = square (50, 0.4, 1);
      RandomStream random (count);
      for (std::size_t i = 0; i < count; ++i)
        points.emplace_back (100.0 + size * (static_cast<double> (i % 4) + 0.3 * random.uniform ()),
                             size * (static_cast<double> (i / 4) + 0.3 * random.uniform ()), 7.0);
      EXPECT_TRUE (outliersOf (points).empty ());
    }
}

TEST (Outliers, DegenerateClouds)
{
  EXPECT_TRUE (findOutliers ({}, {}, 1).empty ());
  for (const std::size_t count : {1U, 5U, 20U, 40U})
    for (const int k : {6, 20}) {
      Positions line;
      for (std::size_t i = 0; i < count; ++i)
        line.emplace_back (static_cast<double> (i), 0.0, 0.0);
      EXPECT_TRUE (outliersOf (line, k).empty ());
    }
  Positions few = square (4, 0.2, 1);
  few.emplace_back (0.0, 0.0, 1e3);
  EXPECT_TRUE (outliersOf (few).empty ()); // too few points
}

TEST (Outliers, AreReportedAndLeftOut)
{
  Positions points = square (30, 0.3, 1);
  points.emplace_back (15.2, 15.1, 5.0);
  points.emplace_back (15.2, 15.1, -40.0);
  points.emplace_back (15.2, 15.1, -40.0); // a duplicate
  Options options;
  for (const Topology topology : {Topology::SURFACE, Topology::DISC}) {
    options.topology = topology;
    const Result result = reconstruct (samples::asInput (points), options);
    EXPECT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
    EXPECT_EQ (result.report.outliers, (std::vector<Index>{900, 901}));
    EXPECT_EQ (result.report.statistics.outlier_points, 2U);
    EXPECT_EQ (result.report.statistics.working_points, 900U);
    EXPECT_FALSE (result.report.warnings.empty ());
    EXPECT_EQ (samples::topologyOf (result.triangles).vertices, 900U);
  }
  options.topology = Topology::SURFACE;
  options.remove_outliers = false;
  const Result all = reconstruct (samples::asInput (points), options);
  EXPECT_TRUE (all.report.outliers.empty ());
  EXPECT_EQ (all.report.statistics.working_points, 902U);
}

} // namespace
} // namespace pcl::floater
