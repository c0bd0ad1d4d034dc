// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scans of known surfaces, made into meshes as they were seen; and where a view is cut: at steps of depth in profiles
// of known surfaces, seen by a lidar with rings, and in parts without rays.
#include "view/view_method.h"

#include "reconstruct.h"
#include "scan_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

// Length of an edge over the larger spacing of its ends across the ray: what joins surfaces one
// behind the other is long.
double
longestAcross (const Scan& scan, const Result& result, double width)
{
  double longest = 0.0;
  for (const Triangle& triangle : result.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = triangle[i], q = triangle[(i + 1) % 3];
      if (scan.object[p] == scan.object[q])
        continue;
      const double depth = (scan.points[p] - scan.viewpoint).norm ();
      longest = std::max (longest, (scan.points[q] - scan.points[p]).norm () / (depth * width));
    }
  return longest;
}

// The ball and the post stand free, so that no edge joins them to what is behind. They touch the
// floor, or cover its meeting with the walls; there, edges are short.
TEST (ViewMethod, DepthStepsAreLeftOut)
{
  for (const DepthNoise noise :
       {DepthNoise{0.0, 0.0}, DepthNoise{0.001, 0.0}, DepthNoise{0.005, 0.0},
        DepthNoise{0.0, 0.003}, DepthNoise{0.0, 0.004}})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE (testing::Message () << noise.share << " " << noise.quantum << ", " << seed);
      const Scan scan = scanScene (Raster::CAMERA, noise, seed);
      const Result result = viewOf (scan, seenFrom (scan.viewpoint));
      EXPECT_GT (result.report.statistics.view_steps, 100U);
      EXPECT_GT (result.report.statistics.used_points, 0.99 * scan.points.size ());
      EXPECT_LE (result.report.check.components, 8U);
      // The scene has steps of half a unit and more, 80 times the width of a pixel.
      EXPECT_LT (longestAcross (scan, result, 0.006), 60.0);
    }
  for (const Raster raster : {Raster::RINGS, Raster::SPHERE}) {
    const Scan scan = scanScene (raster, {0.005, 0.0}, 3);
    viewOf (scan, seenFrom (scan.viewpoint));
  }
}

// Edges across short steps, which are not left out, bridge what is no surface; the longest go.
TEST (ViewMethod, LongBridgesAreLeftOut)
{
  const Scan scan = scanScene (Raster::CAMERA, {0.001, 0.0}, 1);
  Limits limits;
  limits.view.shortest_step = scan.points.size ();
  const auto longAcross = [&] {
    const Result result = reconstruct (asInput (scan.points), seenFrom (scan.viewpoint), limits);
    EXPECT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
    std::size_t count = 0;
    for (const Triangle& t : result.triangles) {
      Result one;
      one.triangles = {t};
      count += longestAcross (scan, one, 0.006) > 60.0 ? 1 : 0;
    }
    return count;
  };
  const std::size_t left = longAcross ();
  limits.view.longest_edge = 1e9;
  EXPECT_LT (2 * left, longAcross ());
}

// Sixteen rings two degrees apart, and things that hang free before the walls and are as high as one
// or two of them: most edges near the sensor lead to what is behind.
TEST (ViewMethod, FewRingsMakeNoCurtains)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random (seed);
    Scene hall = courtyard ();
    hall.things.clear ();
    for (int i = 0; i < 30; ++i) {
      const double angle = 12.0 * i * DEGREE, distance = 1.3 + 0.3 * (i % 3);
      const double height = distance * (random.uniform () - 0.5) * 0.4;
      hall.things.push_back ({polar (distance, angle, height), 0.1, false});
    }
    const Scan scan = castRays (hall, raysInRings (Eigen::Vector3d::Zero (), 16, 1800, -15.0, 2.0),
                                {0.002, 0.0}, random);
    const Result result = viewOf (scan, seenFrom (scan.viewpoint));
    const int first_thing = static_cast<int> (hall.planes.size ());
    double joined = 0.0, all = 0.0;
    for (const auto& [a, b, c] : result.triangles) {
      const double area = areaVector (scan.points[a], scan.points[b], scan.points[c]).norm ();
      const std::array<bool, 3> on_thing{scan.object[a] >= first_thing,
                                         scan.object[b] >= first_thing,
                                         scan.object[c] >= first_thing};
      all += area;
      joined += on_thing[0] == on_thing[1] && on_thing[1] == on_thing[2] ? 0.0 : area;
    }
    EXPECT_LT (joined, 0.03 * all) << seed;
    EXPECT_GT (result.report.statistics.used_points, 0.9 * scan.points.size ());
  }
}

// Low hills far from a low sensor, none of which hides what is behind it: rings many times as far
// apart as they are wide, and farther behind a crest than before it.
TEST (ViewMethod, GroundSeenAtAGrazingAngleIsWhole)
{
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    RandomStream random (seed);
    Scene hills{{{Eigen::Vector3d::UnitZ (), 0.0}},
                {},
                {Eigen::Vector3d (-35.0, -35.0, -1.0), Eigen::Vector3d (35.0, 35.0, 2.0)}};
    for (int i = 0; i < 12; ++i) {
      const double angle = 30.0 * i * DEGREE, distance = 12.0 + 20.0 * random.uniform (),
                   radius = 300.0, height = 0.15 + 0.15 * random.uniform ();
      hills.things.push_back ({polar (distance, angle, height - radius), radius, false});
    }
    const Scan scan = castRays (hills, raysInRings ({0.0, 0.0, 1.7}, 32, 1800, -25.0, 35.0 / 31.0),
                                {0.0005, 0.0}, random);
    const Result result = viewOf (scan, seenFrom (scan.viewpoint));
    EXPECT_LT (result.report.statistics.view_steps, 20U) << seed;
    EXPECT_EQ (result.report.check.components, 1U);
  }
}

// A flat raster with a square of missing rays.
Positions
rasterWithHole (int hole)
{
  Positions points;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j)
      if (std::abs (i - 30) > hole / 2 || std::abs (j - 30) > hole / 2)
        points.emplace_back (0.01 * (i - 29.5), 0.01 * (j - 29.5), 1.0);
  return points;
}

TEST (ViewMethod, SmallGapsAreFilledAndWideOnesAsThePolicyWantsIt)
{
  Options options = seenFrom (Eigen::Vector3d::Zero ());
  for (const int hole : {1, 3, 7, 15})
    EXPECT_EQ (reconstruct (rasterWithHole (hole), options).report.check.loops.size (),
               hole < 5 ? 1U : 2U);
  options.holes.policy = HolePolicy::KEEP_LARGEST;
  const Report report = reconstruct (rasterWithHole (15), options).report;
  EXPECT_EQ (report.check.loops.size (), 1U);
  EXPECT_EQ (report.statistics.holes_filled, 1U);
}

TEST (ViewMethod, SmallPartsAreOutliersIfOutliersAreLeftOut)
{
  Positions points = rasterWithHole (15);
  const auto square = static_cast<Index> (points.size ());
  for (int i = 0; i < 3; ++i) // seen in the hole, and smaller than a part must be
    for (int j = 0; j < 3; ++j)
      points.emplace_back (0.001 * (i + 0.25), 0.001 * (j + 0.25), 0.1);
  Options options = seenFrom (Eigen::Vector3d::Zero ());
  const Result without = meshOf (points, options);
  EXPECT_EQ (without.report.outliers.size (), 9U);
  EXPECT_EQ (without.report.outliers.front (), square);
  options.remove_outliers = false;
  const Result with = reconstruct (points, options);
  EXPECT_TRUE (with.report.outliers.empty ());
  EXPECT_EQ (with.report.check.components, 2U);
}

TEST (ViewMethod, DiagonalsAreChosenForSmoothness)
{
  const Scan scan = scanScene (Raster::CAMERA, {0.01, 0.0}, 5);
  Options options = seenFrom (scan.viewpoint);
  const Result with = reconstruct (scan.points, options);
  options.flip_edges = false;
  const Result without = reconstruct (scan.points, options);
  EXPECT_EQ (without.report.statistics.flips, 0U);
  EXPECT_EQ (with.triangles.size (), without.triangles.size ());
  // 0.36; in the order of the edges, instead of the best first, 0.48.
  EXPECT_LT (with.report.check.folds, 0.42 * without.report.check.folds);
}

TEST (ViewMethod, AViewThatLeavesManyPointsOutIsTold)
{
  Positions points = rasterWithHole (0);
  for (int part = 0; part < 100; ++part) // beside the raster; each too small for a part
    for (int i = 0; i < 9; ++i)
      points.emplace_back (1.0 + 0.1 * (part / 10) + 0.01 * (i / 3),
                           0.1 * (part % 10) + 0.01 * (i % 3), 1.0);
  const Report report = meshOf (points, seenFrom (Eigen::Vector3d::Zero ())).report;
  EXPECT_EQ (report.check.nonmanifold_vertices, 0U);
  EXPECT_TRUE (warns (report, "at the given viewpoint"));
}

constexpr double ELEVATION = 1.1 * DEGREE; // between rings
constexpr double NEVER = std::numeric_limits<double>::infinity ();

// Surfaces in the plane of height and distance, upright or level, as depths along a ray from the
// sensor at height 0.
double
ground (double elevation)
{
  return elevation < 0.0 ? 1.7 / std::sin (-elevation) : NEVER;
}

double
wall (double elevation, double distance, double lowest)
{
  return distance * std::tan (elevation) >= lowest ? distance / std::cos (elevation) : NEVER;
}

// What rings see of such surfaces is cut into so many parts, whatever the noise.
void
expectParts (std::size_t parts, int lowest, int highest, double most_noise,
             const std::function<double (double)>& depth)
{
  for (const double noise : {0.0, 0.5 * most_noise, most_noise}) {
    SCOPED_TRACE (noise);
    RandomStream random (1);
    Positions points;
    for (const ScanRay& ray : raysInRings (Eigen::Vector3d::Zero (), highest - lowest + 1, 1800,
                                           lowest * ELEVATION / DEGREE, ELEVATION / DEGREE))
      if (const double d = depth (std::asin (ray.along.z ())) + noise * random.normal ();
          std::isfinite (d) && ray.along.y () > 0.98 * ray.along.head<2> ().norm ())
        points.emplace_back (d * ray.along);
    const Report report = meshOf (points, seenFrom (Eigen::Vector3d::Zero ())).report;
    EXPECT_EQ (report.check.components, parts);
    EXPECT_EQ (report.check.loops.size (), parts); // without holes
  }
}

TEST (ViewMethod, IsCutWhereSomethingIsHidden)
{
  // The ground goes on below the side of a box that stands on wheels: its far part is hidden. It is
  // seen up to a distance of 6.3 under the box, which begins at 5.
  expectParts (2, -22, -4, 0.01,
               [] (double e) { return std::min (ground (e), wall (e, 5.0, -1.35)); });
  // A wall behind a roof.
  expectParts (2, -22, 8, 0.01, [] (double e) {
    return std::min (wall (e, 9.0, -NEVER), e < 0.5 * ELEVATION ? 5.0 / std::cos (e) : NEVER);
  });
}

TEST (ViewMethod, IsNotCutWhereSurfacesMeet)
{
  expectParts (1, -22, 4, 0.01,
               [] (double e) { return std::min (ground (e), wall (e, 7.0, -NEVER)); });
  // Far away, the last ring on the ground is 15 times farther from the wall than its rings are
  // apart: a joint too long for one of its surfaces is left open.
  expectParts (2, -22, 4, 0.0,
               [] (double e) { return std::min (ground (e), wall (e, 40.0, -NEVER)); });
  // A wedge that points at the sensor, or away from it; each side goes 3 deep for 1 wide: distance
  // d where d = 5 + 3 sign |d tan e|.
  for (const double sign : {1.0, -1.0})
    expectParts (1, -10, 10, 0.01, [sign] (double e) {
      return 5.0 / (1.0 - 3.0 * sign * std::abs (std::tan (e - 0.4 * ELEVATION))) / std::cos (e);
    });
}

} // namespace
} // namespace pcl::floater
