// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where a view is cut: at steps of depth in profiles of known surfaces, seen by a lidar with rings,
// and in parts without rays.
#include "view/depth_steps.h"

#include "floater/planar_delaunay.h"
#include "samples.h"
#include "view/view_flips.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>

namespace pcl::floater {
namespace {
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
