// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a view without rays.
#include "view/view_flips.h"

#include "core/geometry.h"
#include "floater/planar_delaunay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pcl::floater {
namespace {
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

// Of rays at random, hardly any triangle lies in a gap.
TEST (ViewGaps, RaysAtRandomHaveHardlyAny)
{
  std::mt19937 random (3);
  std::uniform_real_distribution<double> uniform (-0.5, 0.5);
  std::vector<Eigen::Vector3d> positions;
  for (int i = 0; i < 20000; ++i)
    positions.emplace_back (uniform (random), uniform (random), 1.0);
  const Rays rays = makeRays (positions, {Eigen::Vector3d::Zero (), false}, 1);
  const TriangleMesh view = triangulateHull (rays.places);
  const std::vector<std::uint8_t> is_gap = findGaps (view, rays, {}, 1);
  std::size_t inside = 0;
  for (std::size_t t = 0; t < is_gap.size (); ++t) {
    const auto isInside = [&] (Index p) {
      return positions[p].head<2> ().cwiseAbs ().maxCoeff () < 0.45;
    };
    const auto& [a, b, c] = view.triangles[t];
    inside += is_gap[t] != 0 && isInside (a) && isInside (b) && isInside (c) ? 1 : 0;
  }
  EXPECT_LT (inside, 120U); // 3 of 1000 triangles
}

} // namespace
} // namespace pcl::floater
