// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which clouds are taken for a scan, where the sensor was, and which given places are doubted; the rows of a scanner.
#include "scan_samples.h"
#include "view/ray_evidence.h"
#include "view/viewpoint_search.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

Eigen::Vector3d
foundIn (const Report& report)
{
  return Eigen::Vector3d (report.viewpoint.data ());
}

using ScansOfARoom = testing::TestWithParam<std::tuple<Raster, std::uint64_t>>;

// Areas must tell roughly where to look: noise of up to one and a half spacings of a camera's pixels,
// or a third of those of rays in a ring. Along rings, only the spacing within each tells.
TEST_P (ScansOfARoom, TheViewpointIsFound)
{
  const auto& [raster, seed] = GetParam ();
  const bool in_rings = raster == Raster::RINGS;
  const Scan scan = scanScene (raster, {in_rings ? 0.001 : 0.01, 0.0}, seed);
  const Eigen::Vector3d found = foundIn (viewOf (scan, {}).report);
  EXPECT_LT ((found - scan.viewpoint).norm (), in_rings ? 0.5 : 0.1);
}

INSTANTIATE_TEST_SUITE_P (Scans, ScansOfARoom,
                          testing::Combine (testing::Values (Raster::CAMERA, Raster::RINGS,
                                                             Raster::SPHERE),
                                            testing::Range<std::uint64_t> (1, 6)));

// Where curves of a rosette cross, rays nearly coincide, and some points are alone in gaps between
// them; they do not contradict the view.
TEST (Recognition, ARosetteIsRecognised)
{
  // Rays of two turning prisms about +x, from the origin: a rosette of 140 leaves, whose curves cross.
  std::vector<ScanRay> rays;
  for (int i = 0; i < 14000; ++i) {
    const double turn = 2.0 * PI * 20.0 * i / 14000;
    const Eigen::Vector3d prisms = polar (0.166, 7.0 * turn) + polar (0.166, -4.577 * turn);
    const Eigen::Vector3d along (1.0, std::tan (prisms.x ()), std::tan (prisms.y ()));
    rays.push_back ({Eigen::Vector3d::Zero (), along.normalized ()});
  }
  RandomStream random (1);
  const Scan scan = castRays (courtyard (), rays, {0.002, 0.0}, random);
  const Result result = viewOf (scan, {});
  EXPECT_GT (result.report.statistics.used_points, 0.9 * scan.points.size ());
}

// Rings of a car's lidar: each begins anywhere, they are unevenly far apart, and rays are lost.
// \param drive way of the car during the turn, in whose middle it is at the place
Scan
scanOfCar (const std::vector<Eigen::Vector3d>& places, std::uint64_t seed,
           const Eigen::Vector3d& drive = Eigen::Vector3d::Zero (),
           const Scene& scene = courtyard ())
{
  RandomStream random (seed);
  std::vector<ScanRay> rays;
  for (const Eigen::Vector3d& place : places)
    for (int ring = 0; ring < 40; ++ring) {
      const double elevation = -24.0 + (ring < 20 ? 0.8 * ring : 16.0 + 0.35 * (ring - 20));
      const Eigen::AngleAxisd turn (random.uniform (), Eigen::Vector3d::UnitZ ());
      for (ScanRay& ray : raysInRings (place, 1, 900, elevation, 0.0))
        if (random.uniform () > 0.1) {
          const Eigen::Vector3d along = turn * ray.along;
          const double turned = std::atan2 (along.y (), along.x ()) / (2.0 * PI);
          rays.push_back ({place + turned * drive, along});
        }
    }
  return castRays (scene, rays, {0.002, 0.0}, random);
}

// The origin is tried first, and taken as it is; after a shift, the place that was the origin.
TEST (Recognition, ASensorInTheOriginIsToldFromOneBesideIt)
{
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero (), beside (0.3, 1.0, -0.2);
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE (seed);
    EXPECT_EQ (foundIn (viewOf (scanOfCar ({origin}, seed), {}).report), origin);
    const Scan scan = scanOfCar ({beside}, seed);
    EXPECT_LT ((foundIn (viewOf (scan, {}).report) - beside).norm (), 0.1);
    Input shifted = asInput (scan.points);
    Eigen::Map<Eigen::Vector3d> (shifted.shift.data ()) = -beside;
    EXPECT_TRUE (foundIn (reconstruct (std::move (shifted), {}).report).isApprox (beside));
    EXPECT_FALSE (meshOf (scanOfCar ({origin, beside}, seed).points).report.is_view);
  }
}

// While the lidar turns, the car drives: rays to the sides of a post cross, and one of two near rays ends far
// behind the other one.
TEST (Recognition, AScanFromADrivingCarIsRecognised)
{
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero (), beside (0.3, 1.0, -0.2);
  Scene street = courtyard ();
  RandomStream random (1);
  for (int i = 0; i < 12; ++i) {
    const double angle = between (random, 0.0, 2.0 * PI), distance = between (random, 3.0, 6.0);
    street.things.push_back ({polar (distance, angle, -1.6), 0.1, true});
  }
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const auto& [place, way] :
         {std::pair{origin, 1.0}, {origin, 1.5}, {beside, 0.5}, {beside, 1.0}}) {
      SCOPED_TRACE (testing::Message () << "seed " << seed << ", way " << way);
      const Scan scan = scanOfCar ({place}, seed, way * Eigen::Vector3d::UnitX (), street);
      const Eigen::Vector3d found = foundIn (viewOf (scan, {}).report);
      EXPECT_LE ((found - place).norm (), place == origin ? 0.0 : 0.3);
    }
}

TEST (Recognition, WhatNoSensorSawIsNoScan)
{
  // A star of points that are even as seen from its middle, but at changing distances: the view would
  // be closed.
  std::vector<Positions> clouds{evenSphere (5000)};
  for (Eigen::Vector3d& point : clouds.front ())
    point *= 1.0 + 0.4 * std::sin (5.0 * point.x ()) * std::cos (4.0 * point.y ());
  // Rasters of heights, as even from far away, on either side; and points at random.
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RandomStream random (seed);
    const double phase = 6.0 * random.uniform (), height = 0.1 + 0.1 * random.uniform ();
    const Eigen::Vector3d shift (-random.uniform (), -random.uniform (), 0.5 + random.uniform ());
    for (const bool is_raster : {true, false}) {
      Positions& cloud =
          clouds.emplace_back (is_raster ? jitteredGrid (128, 96, 1.0 / 120.0, 0.0, random)
                                         : randomPoints (10000, seed));
      for (Eigen::Vector3d& p : cloud)
        p = shift +
            Eigen::Vector3d (p.x (), p.y (),
                             height * std::sin (5.0 * p.x () + phase) * std::cos (4.0 * p.y ()));
    }
  }
  for (std::size_t cloud = 0; cloud < clouds.size (); ++cloud)
    EXPECT_FALSE (meshOf (clouds[cloud]).report.is_view) << cloud;
}

// A steep raster of heights is as even from far below as from far above: of 90 such clouds, the search came
// to a place a thousand diagonals away for three, which are here. They face up.
TEST (Recognition, ARasterOfSteepHeightsIsSeenFromNoPlace)
{
  for (const std::uint64_t seed : {1, 40, 44, 79}) {
    RandomStream random (seed);
    Positions raster = jitteredGrid (128, 110, 1.0, 0.0, random);
    for (int wave = 0; wave < 4; ++wave) {
      const double width = 10.0 + 50.0 * random.uniform (), angle = 2.0 * PI * random.uniform (),
                   height = 0.5 * width * random.uniform (), phase = 6.0 * random.uniform ();
      for (Eigen::Vector3d& p : raster)
        p.z () += height *
                  std::sin (2.0 / width * (p.x () * std::cos (angle) + p.y () * std::sin (angle)) +
                            phase);
    }
    const Result result = meshOf (raster);
    EXPECT_EQ (result.report.is_view, result.report.is_far_view) << seed;
    EXPECT_EQ (shareFacing (result, raster, [] (const auto&) { return Eigen::Vector3d::UnitZ (); }),
               1.0)
        << seed;
  }
}

// Along lines, points tell that they were scanned even if there is hardly any noise. Of the seeds 1
// to 40, the direction that is found for the 10th is 1.8 degrees off, those of all others are
// right.
TEST (Recognition, TheDirectionOfALineScannerIsFound)
{
  constexpr double RIGHT = 1.0 - 1e-5, NEAR = 0.999; // cosines
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE (seed);
    const Scan scan = scanScene (Raster::LINES, {0.0002, 0.0}, seed);
    const Report report = viewOf (scan, {}).report;
    const double cosine = std::abs (foundIn (report).dot (scan.viewpoint));
    EXPECT_GT (cosine, NEAR);
    right += cosine > RIGHT ? 1 : 0;
    EXPECT_LE (report.check.components, 8U);
  }
  EXPECT_GE (right, 11);
}

// A ball on a table under parallel rays in rows 5 steps apart. Nearly all rows are those of the
// table, which have one direction and tell nothing.
TEST (Recognition, TheDirectionOfALineScannerOverATableIsFound)
{
  constexpr int SIDE = 120;
  constexpr double RADIUS = 40.0, FAR = 1000.0;
  const Eigen::Vector3d row = Eigen::Vector3d::UnitY ();
  const Scene table{{{Eigen::Vector3d::UnitZ (), 0.0}},
                    {{{0.0, 0.0, RADIUS}, RADIUS, false}},
                    {Eigen::Vector3d::Constant (-FAR), Eigen::Vector3d::Constant (FAR)}};
  for (const double elevation : {20.0, 40.0, 60.0}) {
    SCOPED_TRACE (elevation);
    const double angle = elevation * DEGREE;
    const Eigen::Vector3d towards (std::cos (angle), 0.0, std::sin (angle));
    const Eigen::Vector3d across = towards.cross (row);
    RandomStream random (385);
    std::vector<ScanRay> rays;
    for (int i = -SIDE / 5; i <= SIDE / 5; ++i)
      for (int j = -SIDE; j <= SIDE; ++j)
        rays.push_back ({5.0 * i * across + 1.0 * j * row + FAR * towards, -towards});
    const Scan scan = castRays (table, rays, {0.01 / FAR, 0.0}, random);
    const Report report = meshOf (scan.points).report;
    EXPECT_TRUE (report.is_view);
    EXPECT_GT (std::abs (foundIn (report).dot (towards)), 1.0 - 1e-5);
  }
}

// Before a corner of a room, depths change by less than they do by noise from one pixel to the next.
TEST (Recognition, ANoisyFrameOfACornerIsRecognised)
{
  const Eigen::Vector3d place (1.0, 2.0, 3.0);
  Scene corner{{}, {}, {Eigen::Vector3d::Constant (-100.0), Eigen::Vector3d::Constant (100.0)}};
  for (const auto& [normal, offset] : {std::pair (Eigen::Vector3d (0.3, 0.0, -1.0), -2.0),
                                       {Eigen::Vector3d (0.0, -1.0, -0.3), -1.0},
                                       {Eigen::Vector3d (-1.0, 0.1, -0.8), -2.2}})
    corner.planes.push_back ({normal, offset + normal.dot (place)});
  for (const double noise : {0.003, 0.005}) { // a pixel is 0.006 wide
    SCOPED_TRACE (noise);
    RandomStream random (385);
    const Eigen::Vector3d look = Eigen::Vector3d (0.1, 0.1, 1.0).normalized ();
    const Scan scan = castRays (corner, raysOf (Raster::CAMERA, place, look), {noise, 0.0}, random);
    const Report report = meshOf (scan.points).report;
    ASSERT_TRUE (report.is_view);
    EXPECT_LT ((foundIn (report) - place).norm (), 0.005);
  }
}

// A ball and a bowl, lit by a stripe of light from one place, and measured from another one. A tenth of
// the points are lost. Nothing else tells that the bowl is seen from within.
TEST (Recognition, ABowlBeforeARangeScannerFacesIt)
{
  const Eigen::Vector3d light (0.25, 0.0, 0.8), camera (0.0, 0.0, 0.8);
  const Scene scene{{},
                    {{{-0.13, 0.02, -0.09}, 0.08, false}, {{0.13, 0.0, 0.0}, -0.11, false}},
                    {Eigen::Vector3d (-10.0, -10.0, -10.0), Eigen::Vector3d (10.0, 10.0, -0.01)}};
  for (const int half : {130, 80}) { // the width of the frame
    SCOPED_TRACE (half);
    RandomStream random (1);
    const double step = 0.325 / half;
    const auto measure = [&] (const Eigen::Vector3d& from, const Eigen::Vector3d& along,
                              double noise) {
      return castRays (scene, {{from, along.normalized ()}}, {noise, 0.0}, random).points;
    };
    Positions points;
    for (int i = -half; i <= half; ++i)
      for (int j = -half; j <= half; ++j) {
        const Positions lit = measure (light, {step * i - 0.3, step * j, -1.0}, 0.0);
        if (lit.empty () || random.uniform () < 0.1)
          continue;
        const Positions seen = measure (camera, lit.front () - camera, 1e-4);
        if (!seen.empty () && (seen.front () - lit.front ()).norm () < 1e-3)
          points.push_back (seen.front ());
      }
    const Result result = meshOf (points);
    EXPECT_TRUE (result.report.is_view);
    EXPECT_EQ (shareFacing (result, points, [&] (const auto& p) { return camera - p; }), 1.0);
  }
}

// A sensor that stands low on wide ground is near its mirror image below it, from where points
// stand for the same areas.
TEST (Recognition, AScannerLowOnTheGroundIsFound)
{
  int right = 0;
  for (std::uint64_t seed = 5; seed <= 9; ++seed) {
    const Scan scan = scanYard (80.0, 2.0, false, seed);
    const Eigen::Vector3d found = foundIn (viewOf (scan, {}).report);
    right += (found - scan.viewpoint).norm () < 0.01 ? 1 : 0;
  }
  EXPECT_GE (right, 4);
}

// Far off the middle of wide ground, a cell of a grid of places is many times as wide as the scanner is
// high.
TEST (Recognition, AScannerOffTheMiddleOfWideGroundIsFound)
{
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Scan scan = scanYard (120.0, 30.0, seed % 2 == 0, seed);
    EXPECT_LT ((foundIn (viewOf (scan, {}).report) - scan.viewpoint).norm (), 0.1) << seed;
  }
}

// Rays in rings up to the zenith, where they coincide, and in few rings, which are noisy: there the
// search ends early at first.
TEST (Recognition, AScannerInARoomIsFoundToAFractionOfAStep)
{
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX (), y = Eigen::Vector3d::UnitY (),
                        z = Eigen::Vector3d::UnitZ ();
  const Scene room{{{z, 0.0}, {z, 2.6}, {x, 3.0}, {x, -3.0}, {y, 2.5}, {y, -3.0}},
                   {{{1.0, 0.4, 0.9}, 0.3, false}, {{0.8, -0.8, 0.0}, 0.25, true}},
                   {Eigen::Vector3d (-3.1, -3.1, -0.1), Eigen::Vector3d (3.1, 2.6, 2.7)}};
  for (const std::uint64_t seed : {1, 2, 4}) {
    RandomStream random (seed);
    const Eigen::Vector3d place (-0.6 - random.uniform (), random.uniform () - 0.5,
                                 1.2 + 0.4 * random.uniform ());
    for (const bool is_dense : {true, false}) {
      SCOPED_TRACE (std::to_string (seed) + (is_dense ? ", dense" : ", few rings"));
      const Scan scan = castRays (room,
                                  is_dense ? raysInRings (place, 201, 480, -60.0, 0.75)
                                           : raysInRings (place, 32, 1800, -25.0, 35.0 / 31.0),
                                  {is_dense ? 0.0007 : 0.005, 0.0}, random);
      const Eigen::Vector3d found = foundIn (viewOf (scan, {}).report);
      EXPECT_LT ((found - place).norm (), 0.002);
    }
  }
}

// Twenty rows of 200 points: lines, circles, and lines of which every tenth goes up a slope.
TEST (RowEvidence, OfLinesAndCirclesAndOfNoRows)
{
  Positions lines, circles, slopes, random = randomPoints (4000, 385);
  for (Eigen::Vector3d& p : random) {
    p.z () = 0.0;
    const auto i = static_cast<int> (lines.size ()), row = i / 200, at = i % 200;
    lines.emplace_back (at, 10.0 * row, 0.02 * row * at);
    circles.push_back (polar (40.0, 0.0314 * at, 12.0 * row));
    slopes.emplace_back (lines.back () + Eigen::Vector3d (0, 0, row % 10 == 0 ? 2.0 * at : 0.0));
  }
  const auto rowsOf = [] (const Positions& positions) {
    const Points points = workingPoints (positions);
    const CsrLists all = findNeighbors (points, {}, 1);
    return findRows (points, [&all] (Index p) { return all.row (p); });
  };
  EXPECT_GT (rowsOf (lines).share, 0.95);
  EXPECT_TRUE (rowsOf (lines).are_straight);
  EXPECT_GT (rowsOf (circles).share, 0.95);
  EXPECT_FALSE (rowsOf (circles).are_straight);
  EXPECT_GT (std::abs (rowsOf (circles).across.z ()), 0.999);
  EXPECT_FALSE (rowsOf (slopes).are_straight); // enough to know the plane of the rows
  EXPECT_GT (std::abs (rowsOf (slopes).across.y ()), 0.99);
  // By chance, the second neighbour lies opposite to the first one in a quarter of all directions.
  EXPECT_LT (rowsOf (random).share, 0.5);
}

// Whoever thins a scan at random knows its viewpoint better than its points tell. A wrong one is
// not told where no other place is found: scans of 20,000 points are small.
TEST (GivenViewpoint, IsDoubtedIfItIsWrong)
{
  using Eigen::Vector3d;
  const auto isDoubted = [] (const Positions& points, const Vector3d& viewpoint,
                             const Vector3d& origin_of_file = Vector3d::Zero ()) {
    Input input = asInput (points);
    Eigen::Map<Vector3d> (input.sensor_origin.data ()) = origin_of_file;
    const Report report = reconstruct (std::move (input), seenFrom (viewpoint)).report;
    EXPECT_EQ (report.status, RunStatus::SUCCESS) << report.message;
    EXPECT_TRUE (report.is_view);
    return warns (report, "not as seen from the given viewpoint");
  };
  int told = 0, given = 0;
  for (const Raster raster : {Raster::CAMERA, Raster::RINGS, Raster::SPHERE})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE (seed);
      for (const double noise : {0.0, 0.005}) {
        const Scan noisy = scanScene (raster, {noise, 0.0}, seed);
        EXPECT_FALSE (isDoubted (noisy.points, noisy.viewpoint)) << noise;
      }
      const Scan scan = scanScene (raster, {0.002, 0.0}, seed);
      // A place beside the sensor, in a random direction, at a distance in box diagonals.
      const auto besideSensor = [&scan, seed] (double distance) -> Vector3d {
        Eigen::AlignedBox3d box;
        for (const Vector3d& p : scan.points)
          box.extend (p);
        RandomStream random (seed);
        return scan.viewpoint +
               distance * box.diagonal ().norm () * normalVector (random).normalized ();
      };
      for (const double distance : {0.1, 1.0}) {
        ++given;
        told += isDoubted (scan.points, besideSensor (distance)) ? 1 : 0;
      }
      EXPECT_FALSE (isDoubted (scan.points, scan.viewpoint, scan.viewpoint));
      if (raster != Raster::CAMERA)
        continue;
      // The origin of the file tells that another place is wrong.
      EXPECT_TRUE (isDoubted (scan.points, besideSensor (0.3), scan.viewpoint));
      RandomStream random (seed);
      Positions half;
      for (const Vector3d& p : scan.points)
        if (random.below (2) == 0)
          half.push_back (p);
      EXPECT_FALSE (isDoubted (half, scan.viewpoint));
    }
  EXPECT_GE (4 * told, 3 * given) << "of " << given;
}

} // namespace
} // namespace pcl::floater
