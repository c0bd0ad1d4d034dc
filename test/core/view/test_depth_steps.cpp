// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where a view is cut: profiles of known surfaces, seen by a lidar with rings.
#include "view/depth_steps.h"

#include "core/geometry.h"
#include "floater/planar_delaunay.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>

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

template <typename Depth>
Cuts
cutsOf (int lowest, int highest, double noise, Depth depth)
{
  std::mt19937 random (1);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> positions;
  std::vector<int> ring_of;
  for (int ring = lowest; ring <= highest; ++ring)
    for (int i = 0; i < COLUMNS; ++i) {
      const double elevation = ring * ELEVATION, azimuth = i * AZIMUTH;
      const double d = depth (elevation) + noise * normal (random);
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

using Rings = std::vector<int>;

class StepNoise : public testing::TestWithParam<double>
{
};

// The ground goes on below the side of a box that stands on wheels: its far part is hidden.
TEST_P (StepNoise, AnOverhangIsAStep)
{
  const Cuts cuts = cutsOf (-22, -4, GetParam (), [] (double e) {
    return std::min (ground (e, 1.7), wall (e, 5.0, -1.35));
  });
  // The ground is seen up to a distance of 6.3 under the box, which begins at 5.
  EXPECT_EQ (cuts.whole, Rings{-14});
  EXPECT_EQ (cuts.partial, Rings{});
}

TEST_P (StepNoise, GroundAndWallAreConnectedWhereTheyMeet)
{
  const Cuts cuts = cutsOf (-22, 4, GetParam (), [] (double e) {
    return std::min (ground (e, 1.7), wall (e, 7.0, -NEVER));
  });
  EXPECT_EQ (cuts.whole, Rings{});
  EXPECT_EQ (cuts.partial, Rings{});
}

TEST_P (StepNoise, AWallBehindARoofIsAStep)
{
  const Cuts cuts = cutsOf (-22, 8, GetParam (), [] (double e) {
    return std::min (wall (e, 9.0, -NEVER), e < 0.5 * ELEVATION ? 5.0 / std::cos (e) : NEVER);
  });
  EXPECT_EQ (cuts.whole, Rings{0});
  EXPECT_EQ (cuts.partial, Rings{});
}

// A wedge that points at the sensor, or away from it; each side goes 3 deep for 1 wide.
TEST_P (StepNoise, SharpCreasesAreConnected)
{
  for (const double sign : {1.0, -1.0}) {
    const Cuts cuts = cutsOf (-10, 10, GetParam (), [sign] (double e) {
      // Distance d where d = 5 + 3 sign |d tan e|.
      return 5.0 / (1.0 - 3.0 * sign * std::abs (std::tan (e - 0.4 * ELEVATION))) / std::cos (e);
    });
    EXPECT_EQ (cuts.whole, Rings{}) << sign;
    EXPECT_EQ (cuts.partial, Rings{}) << sign;
  }
}

INSTANTIATE_TEST_SUITE_P (View, StepNoise, testing::Values (0.0, 0.005, 0.01));

// Far away, the last ring on the ground is 15 times farther from the wall than its rings are apart.
TEST (DepthSteps, AJointTooLongForOneOfItsSurfacesIsLeftOpen)
{
  const Cuts cuts = cutsOf (
      -22, 4, 0.0, [] (double e) { return std::min (ground (e, 1.7), wall (e, 40.0, -NEVER)); });
  EXPECT_EQ (cuts.whole, Rings{-3});
  EXPECT_EQ (cuts.partial, Rings{});
}

} // namespace
} // namespace pcl::floater
