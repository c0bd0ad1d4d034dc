// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The place of a sensor: what points tell of their rays, of rows, and of where it was.
#include "view/ray_evidence.h"

#include "samples.h"
#include "scan_samples.h"
#include "view/view_method.h"
#include "view/viewpoint_search.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

Viewpoint
inPoints (const Points& points, const Eigen::Vector3d& viewpoint, bool is_far)
{
  return {is_far ? viewpoint : Eigen::Vector3d ((viewpoint - points.centre) / points.scale),
          is_far};
}

bool
isSeen (const Positions& positions, const Eigen::Vector3d& viewpoint, bool is_far = false)
{
  const Points points = workingPoints (positions);
  return isSeenFrom (points, inPoints (points, viewpoint, is_far), {}, 2);
}

class RastersAndSeeds : public testing::TestWithParam<std::tuple<Raster, std::uint64_t>>
{
protected:
  Scan scan (DepthNoise noise) const
  {
    return scanScene (std::get<0> (GetParam ()), noise, std::get<1> (GetParam ()));
  }
};

TEST_P (RastersAndSeeds, AScanIsSeenFromItsSensorAndNotFromElsewhere)
{
  const Scan made = scan ({0.003, 0.0});
  EXPECT_TRUE (isSeen (made.points, made.viewpoint, made.is_far));
  if (made.is_far) {
    const Eigen::Vector3d aslant = made.viewpoint + 0.5 * made.viewpoint.unitOrthogonal ();
    EXPECT_FALSE (isSeen (made.points, aslant.normalized (), true));
  }
  else
    for (const Eigen::Vector3d& axis :
         {Eigen::Vector3d (1.5, 0.0, 0.0), Eigen::Vector3d (0.0, 1.5, 0.0),
          Eigen::Vector3d (0.0, 0.0, 1.5)})
      EXPECT_FALSE (isSeen (made.points, made.viewpoint + axis)) << axis.transpose ();
}

TEST_P (RastersAndSeeds, TheViewpointIsFound)
{
  // Areas must tell roughly where to look: noise of up to one and a half spacings of a camera's
  // pixels, or a third of those of rays in a ring.
  const Raster raster = std::get<0> (GetParam ());
  const bool is_hard = raster == Raster::RINGS || raster == Raster::PARALLEL;
  const Scan made = scan ({is_hard ? 0.001 : 0.01, 0.0});
  const Points points = workingPoints (made.points);
  StarSettings settings;
  settings.reach_beyond = true;
  const LocalPlanes planes =
      fitLocalPlanes (points, findNeighbors (points, {}, 2), std::nullopt, settings, 2);
  const std::vector<AreaSample> samples =
      takeAreaSamples (points, planes, settings, SearchLimits{}.samples, 2);
  std::optional<Viewpoint> found;
  for (const SearchReason reason : {SearchReason::UNEVEN, SearchReason::NOISE})
    if (!found)
      found = findViewpoint (points, planes.neighbors, samples, reason, {}, {}, 2);
  ASSERT_TRUE (found);
  if (found->is_far)
    EXPECT_GT (std::abs (found->place.dot (made.viewpoint)), 0.999);
  else if (made.is_far) { // so far away that it makes no difference
    const Eigen::Vector3d offset =
        found->place - inPoints (points, made.points.front (), false).place;
    EXPECT_GT (offset.norm (), 5.0);
    EXPECT_GT (std::abs (offset.normalized ().dot (made.viewpoint)), 0.99);
  }
  else
    // Along rings, only the spacing within each tells.
    EXPECT_LT ((found->place - inPoints (points, made.viewpoint, false).place).norm (),
               raster == Raster::RINGS ? 0.06 : 0.01);
}

INSTANTIATE_TEST_SUITE_P (Scans, RastersAndSeeds,
                          testing::Combine (testing::Values (Raster::CAMERA, Raster::RINGS,
                                                             Raster::SPHERE, Raster::PARALLEL),
                                            testing::Range<std::uint64_t> (1, 6)));

TEST (RayEvidence, PointsAtRandomAreNotSeenFromAnywhere)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random (seed);
    Positions points = randomPoints (10000, seed);
    for (Eigen::Vector3d& p : points)
      p.z () = 0.1 * std::sin (6.0 * p.x ());
    const Eigen::Vector3d above (random.uniform (), random.uniform (), 0.5 + random.uniform ());
    EXPECT_FALSE (isSeen (points, above)) << seed;
  }
}

TEST (RayEvidence, AnEvenBallIsNotSeenFromItsCentre)
{
  EXPECT_FALSE (isSeen (evenSphere (20000), Eigen::Vector3d::Zero ()));
}

// Rings of a car's lidar: each begins anywhere, they are unevenly far apart, and rays are lost.
Scan
scanOfCar (const std::vector<Eigen::Vector3d>& places, std::uint64_t seed)
{
  RandomStream random (seed);
  std::vector<ScanRay> rays;
  for (const Eigen::Vector3d& place : places)
    for (int ring = 0; ring < 40; ++ring) {
      const double elevation = -24.0 + (ring < 20 ? 0.8 * ring : 16.0 + 0.35 * (ring - 20));
      const Eigen::AngleAxisd turn (random.uniform (), Eigen::Vector3d::UnitZ ());
      for (ScanRay& ray : raysInRings (place, 1, 900, elevation, 0.0))
        if (random.uniform () > 0.1)
          rays.push_back ({place, turn * ray.along});
    }
  return castRays (courtyard (), rays, {0.002, 0.0}, random);
}

TEST (RayEvidence, UnevenRingsWithLostRaysAreSeenFromOnePlaceNotFromTwo)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Eigen::Vector3d first = Eigen::Vector3d::Zero (), second (0.3, 1.0, -0.2);
    EXPECT_TRUE (isSeen (scanOfCar ({first}, seed).points, first)) << seed;
    EXPECT_FALSE (isSeen (scanOfCar ({first}, seed).points, second)) << seed;
    EXPECT_FALSE (isSeen (scanOfCar ({first, second}, seed).points, first)) << seed;
  }
}

constexpr std::size_t SAMPLES = 200;

RowEvidence
rowsOf (const Positions& positions)
{
  const Points points = workingPoints (positions);
  return findRows (points, findNeighbors (points, {}, 1), SAMPLES);
}

// Sections of a cylinder along z: 20 circles of 200 points.
Positions
circles ()
{
  Positions positions;
  for (int row = 0; row < 20; ++row)
    for (int i = 0; i < 200; ++i)
      positions.emplace_back (40.0 * std::cos (i * 0.0314), 40.0 * std::sin (i * 0.0314),
                              12.0 * row);
  return positions;
}

TEST (RowEvidence, OfLinesAndCirclesAndOfNoRows)
{
  Positions lines, random = randomPoints (4000, 385);
  for (int row = 0; row < 20; ++row)
    for (int i = 0; i < 200; ++i)
      lines.emplace_back (i, 10.0 * row, 0.02 * row * i);
  for (Eigen::Vector3d& p : random)
    p.z () = 0.0;
  const RowEvidence of_lines = rowsOf (lines), of_circles = rowsOf (circles ());
  EXPECT_GT (of_lines.share, 0.95);
  EXPECT_TRUE (of_lines.are_straight);
  EXPECT_GT (of_circles.share, 0.95);
  EXPECT_FALSE (of_circles.are_straight);
  EXPECT_GT (std::abs (of_circles.across.z ()), 0.999);
  // Every tenth row goes up a slope: enough to know the plane of the rows.
  for (int i = 0; i < 4000; ++i)
    if (i / 200 % 10 == 0)
      lines[static_cast<std::size_t> (i)].z () += 2.0 * (i % 200);
  const RowEvidence of_slopes = rowsOf (lines);
  EXPECT_FALSE (of_slopes.are_straight);
  EXPECT_GT (std::abs (of_slopes.across.y ()), 0.99);
  // By chance, the second neighbour lies opposite to the first one in a quarter of all directions.
  EXPECT_LT (rowsOf (random).share, 0.5);
}

std::optional<Viewpoint>
searchEven (const Points& points)
{
  const LocalPlanes planes = fitLocalPlanes (points, findNeighbors (points, {}, 2), {}, {}, 2);
  const std::vector<AreaSample> samples =
      takeAreaSamples (points, planes, {}, SearchLimits{}.samples, 2);
  return findViewpoint (points, planes.neighbors, samples, SearchReason::OPEN, {}, {}, 2);
}

// A raster of heights is as even from far away, on either side.
TEST (ViewpointSearch, FindsNoneOverARasterOfHeights)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RandomStream random (seed);
    const double phase = 6.0 * random.uniform (), height = 0.1 + 0.1 * random.uniform ();
    Positions raster;
    for (int row = 0; row < 96; ++row)
      for (int column = 0; column < 128; ++column) {
        const double u = column / 120.0, v = row / 120.0;
        raster.emplace_back (u, v, height * std::sin (5.0 * u + phase) * std::cos (4.0 * v));
      }
    EXPECT_FALSE (searchEven (workingPoints (raster))) << seed;
  }
}

} // namespace
} // namespace pcl::floater
