// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scans of known surfaces, made into meshes as they were seen; and where a view is cut: at steps of depth in profiles
// of known surfaces, seen by a lidar with rings, and in parts without rays.
#include "view/view_method.h"

#include "floater/planar_delaunay.h"
#include "reconstruct.h"
#include "scan_samples.h"
#include "view/depth_steps.h"
#include "view/view_flips.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <map>

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
      hall.things.push_back ({{distance * std::cos (angle), distance * std::sin (angle),
                               distance * (random.uniform () - 0.5) * 0.4},
                              0.1,
                              false});
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
      hills.things.push_back (
          {{distance * std::cos (angle), distance * std::sin (angle), height - radius},
           radius,
           false});
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
  EXPECT_LT (with.report.check.folds, 0.8 * without.report.check.folds);
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

TEST (ViewMethod, AllPointsOnOneRayGiveNoMesh)
{
  Positions points;
  for (int i = 1; i < 10; ++i)
    points.emplace_back (0.0, 0.0, i);
  points.emplace_back (0.0, 1e-3, 5.0);
  const Result result = reconstruct (points, seenFrom (Eigen::Vector3d::Zero ()));
  EXPECT_EQ (result.report.status, RunStatus::INVALID_OPTION);
  EXPECT_NE (result.report.message.find ("viewpoint"), std::string::npos);
  EXPECT_TRUE (result.triangles.empty ());
}

constexpr int COLUMNS = 100;
constexpr double AZIMUTH = 0.2 * DEGREE, ELEVATION = 1.1 * DEGREE;
constexpr double NEVER = std::numeric_limits<double>::infinity ();

// Surfaces in the plane of height and distance, upright or level, as depths along a ray from the
// sensor at height 0.
double
ground (double elevation, double below)
{
  return elevation < 0.0 ? below / std::sin (-elevation) : NEVER;
}

double
wall (double elevation, double distance, double lowest)
{
  return distance * std::tan (elevation) >= lowest ? distance / std::cos (elevation) : NEVER;
}

// How many rings end in a step: no triangle between them and the next is left in the middle of the
// rings, and how many have a step at some place only.
struct Cuts
{
  std::vector<int> whole, partial; // the lower ring of each
};

Cuts
cutsOf (int lowest, int highest, double noise, const std::function<double (double)>& depth)
{
  RandomStream random (1);
  std::vector<Eigen::Vector3d> positions;
  std::vector<int> ring_of;
  for (int ring = lowest; ring <= highest; ++ring)
    for (int i = 0; i < COLUMNS; ++i) {
      const double elevation = ring * ELEVATION, azimuth = i * AZIMUTH;
      const double d = depth (elevation) + noise * random.normal ();
      if (!std::isfinite (d))
        continue;
      positions.emplace_back (d * std::cos (elevation) * std::cos (azimuth),
                              d * std::cos (elevation) * std::sin (azimuth),
                              d * std::sin (elevation));
      ring_of.push_back (ring);
    }
  const Rays rays = makeRays (positions, {Eigen::Vector3d::Zero (), false}, 1);
  const TriangleMesh view = triangulateHull (rays.places);
  const std::vector<std::uint8_t> is_step = findDepthSteps (view, rays, {}, 1);
  std::map<int, std::array<int, 2>> seen; // of each lower ring: triangles, and those of steps
  for (std::size_t t = 0; t < is_step.size (); ++t) {
    const auto& [a, b, c] = view.triangles[t];
    const int low = std::min ({ring_of[a], ring_of[b], ring_of[c]});
    const int high = std::max ({ring_of[a], ring_of[b], ring_of[c]});
    const auto isInside = [] (Index p) { return p % COLUMNS > 5 && p % COLUMNS < COLUMNS - 5; };
    if (high != low + 1 || !isInside (a) || !isInside (b) || !isInside (c))
      continue;
    ++seen[low][0];
    seen[low][1] += is_step[t];
  }
  Cuts cuts;
  for (const auto& [ring, counts] : seen) {
    if (counts[1] == counts[0])
      cuts.whole.push_back (ring);
    else if (counts[1] > counts[0] / 20)
      cuts.partial.push_back (ring);
  }
  return cuts;
}

// All rings that end in a step, and no partial steps, whatever the noise.
void
expectSteps (const std::vector<int>& rings, int lowest, int highest, double most_noise,
             const std::function<double (double)>& depth)
{
  for (const double noise : {0.0, 0.5 * most_noise, most_noise}) {
    SCOPED_TRACE (noise);
    const Cuts cuts = cutsOf (lowest, highest, noise, depth);
    EXPECT_EQ (cuts.whole, rings);
    EXPECT_EQ (cuts.partial, std::vector<int>{});
  }
}

TEST (DepthSteps, AreWhereSomethingIsHidden)
{
  // The ground goes on below the side of a box that stands on wheels: its far part is hidden. It is
  // seen up to a distance of 6.3 under the box, which begins at 5.
  expectSteps ({-14}, -22, -4, 0.01,
               [] (double e) { return std::min (ground (e, 1.7), wall (e, 5.0, -1.35)); });
  // A wall behind a roof.
  expectSteps ({0}, -22, 8, 0.01, [] (double e) {
    return std::min (wall (e, 9.0, -NEVER), e < 0.5 * ELEVATION ? 5.0 / std::cos (e) : NEVER);
  });
}

TEST (DepthSteps, AreNotWhereSurfacesMeet)
{
  expectSteps ({}, -22, 4, 0.01,
               [] (double e) { return std::min (ground (e, 1.7), wall (e, 7.0, -NEVER)); });
  // Far away, the last ring on the ground is 15 times farther from the wall than its rings are
  // apart: a joint too long for one of its surfaces is left open.
  expectSteps ({-3}, -22, 4, 0.0,
               [] (double e) { return std::min (ground (e, 1.7), wall (e, 40.0, -NEVER)); });
  // A wedge that points at the sensor, or away from it; each side goes 3 deep for 1 wide: distance
  // d where d = 5 + 3 sign |d tan e|.
  for (const double sign : {1.0, -1.0})
    expectSteps ({}, -10, 10, 0.01, [sign] (double e) {
      return 5.0 / (1.0 - 3.0 * sign * std::abs (std::tan (e - 0.4 * ELEVATION))) / std::cos (e);
    });
}

// Angle of the longest edge of the triangles that are in no gap.
double
longestEdge (const std::vector<Eigen::Vector3d>& positions)
{
  const Rays rays = makeRays (positions, {Eigen::Vector3d::Zero (), false}, 1);
  const TriangleMesh view = triangulateHull (rays.places);
  const std::vector<std::uint8_t> is_gap = findGaps (view, rays, {}, 1);
  double longest = 0.0;
  for (std::size_t t = 0; t < is_gap.size (); ++t)
    for (std::size_t i = 0; i < 3 && is_gap[t] == 0; ++i)
      longest =
          std::max (longest, rays.distance (view.triangles[t][i], view.triangles[t][(i + 1) % 3]));
  return longest;
}

constexpr double STEP = 0.003;

// The boundary of what is in reach cuts across the raster of a camera. Along a boundary that curves
// inwards, a point has many slender triangles in the gap, and few on the surface.
TEST (ViewGaps, GapsOfAnyShapeAreFound)
{
  for (const double curve : {0.0, 0.5, 1.0, 2.0, 4.0}) {
    std::vector<Eigen::Vector3d> positions;
    for (int i = -80; i <= 80; ++i)
      for (int j = -60; j <= 60; ++j)
        if (std::abs (j * STEP) > 0.03 + curve * i * STEP * i * STEP)
          positions.emplace_back (i * STEP, j * STEP, 1.0);
    // A block of 4 by 4 missing rays is filled; the gap is at least 20 wide.
    EXPECT_LT (longestEdge (positions), 6.0 * STEP) << curve;
  }
}

} // namespace
} // namespace pcl::floater
