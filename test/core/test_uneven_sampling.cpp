// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method where sampling is far from even: scan lines, rings, steps of density.
#include <pcl/surface/floater/reconstruct.h>

#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pcl::floater {
namespace {
using samples::PI;
using samples::Positions;

// A bent sheet. Its rows are `apart` steps apart, points in a row about one step, and each row
// begins anywhere.
Positions
scanLines (double apart, double noise, std::uint64_t seed)
{
  constexpr int ROWS = 12;
  const int points_in_row = static_cast<int> (3.0 * apart) + 40;
  RandomStream random (seed);
  Positions points;
  for (int row = 0; row < ROWS; ++row) {
    const double shift = random.uniform ();
    for (int i = 0; i < points_in_row; ++i) {
      const double x = i + shift + 0.2 * (random.uniform () - 0.5);
      const double y = apart * (row + noise * random.normal ());
      const double bend = 3.0 * apart;
      points.emplace_back (x, y, bend * std::cos (y / (4.0 * apart)) + noise * random.normal ());
    }
  }
  return points;
}

// Rings on flat ground, as of a spinning lidar: each ring farther from the next by a tenth.
Positions
rings (std::uint64_t seed)
{
  constexpr int RINGS = 20, POINTS = 600;
  RandomStream random (seed);
  Positions points;
  double radius = 3.0;
  for (int ring = 0; ring < RINGS; ++ring, radius *= 1.1) {
    const double shift = random.uniform ();
    for (int i = 0; i < POINTS; ++i) {
      const double angle = 2.0 * PI * (i + shift) / POINTS;
      points.emplace_back (radius * std::cos (angle), radius * std::sin (angle),
                           0.002 * random.normal ());
    }
  }
  return points;
}

// Two jittered grids side by side, their steps 1 and `ratio`.
Positions
densityStep (int ratio, std::uint64_t seed)
{
  constexpr double JITTER = 0.2;
  RandomStream random (seed);
  Positions points;
  const auto add = [&] (double x, double y, double step) {
    points.emplace_back (x + JITTER * step * (random.uniform () - 0.5),
                         y + JITTER * step * (random.uniform () - 0.5), 0.0);
  };
  const int across = 8 * ratio;
  for (int i = -20; i < 0; ++i)
    for (int j = 0; j <= across; ++j)
      add (i, j, 1.0);
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j)
      add ((i + 0.5) * ratio, j * ratio, ratio);
  return points;
}

void
expectOneFlatSheet (const Positions& points, std::size_t loops = 1)
{
  const Result result = reconstruct (samples::asInput (points), {});
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  EXPECT_EQ (result.report.statistics.used_points, points.size ());
  const samples::Topology topology = samples::topologyOf (result.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.components, 1U);
  EXPECT_EQ (topology.loops.size (), loops);
  EXPECT_EQ (topology.euler, 2 - static_cast<long> (loops));
  EXPECT_EQ (result.report.check.folds, 0U);
}

class ScanLines : public testing::TestWithParam<int>
{
};

TEST_P (ScanLines, AreOneSheet)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE (seed);
    expectOneFlatSheet (scanLines (GetParam (), 0.0, seed));
    expectOneFlatSheet (scanLines (GetParam (), 0.01, seed));
  }
}

INSTANTIATE_TEST_SUITE_P (Apart, ScanLines, testing::Values (2, 3, 5, 10, 20, 30));

class DensityStep : public testing::TestWithParam<int>
{
};

TEST_P (DensityStep, IsNoBoundary)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE (seed);
    expectOneFlatSheet (densityStep (GetParam (), seed));
  }
}

INSTANTIATE_TEST_SUITE_P (Ratio, DensityStep, testing::Values (2, 5, 10, 30));

TEST (Rings, AreOneRing)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE (seed);
    expectOneFlatSheet (rings (seed), 2);
  }
}

} // namespace
} // namespace pcl::floater
