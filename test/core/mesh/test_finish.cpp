// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The insertion of missing points, and what the end of a mesh repairs.
#include "mesh/finish.h"

#include "floater/planar_delaunay.h"
#include "mesh/insertion.h"
#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using namespace samples;

// A round sheet laid out as it is, some of whose inner points have no place in the plane.
TEST (Insertion, PutsEveryPointIn)
{
  const double nowhere = std::numeric_limits<double>::quiet_NaN ();
  const Sheet sheet = disc (0.07, 7);
  const auto [points, geometry] = makeNeighborhoods (sheet.positions);
  std::vector<Index> loop (sheet.border);
  std::vector<Eigen::Vector2d> uv;
  RandomStream random (8);
  std::size_t missing = 0;
  for (Index p = 0; p < points.size (); ++p) {
    uv.emplace_back (points.positions[p].head<2> ());
    if (const Index at = points.cloud_index[p]; at < sheet.border)
      loop[at] = p;
    else if (random.uniform () < 0.2) {
      uv[p].setConstant (nowhere);
      ++missing;
    }
  }
  TriangleMesh mesh = triangulatePlane (uv, loop);
  const std::vector<Eigen::Vector3f> normals (points.size (), Eigen::Vector3f::UnitZ ());
  const TriangleCost cost (points.positions, normals);
  EXPECT_EQ (insertMissingPoints (mesh, geometry.neighbors, cost, false, 1), missing);
  expectDisc (mesh, points.size ());
  EXPECT_EQ (insertMissingPoints (mesh, geometry.neighbors, cost, false, 1), 0U);
}

TEST (Finish, FindsAsManyCrossingPairsWithAndWithoutRepair)
{
  const Input input =
      asInput (generateSurface ({SurfaceKind::FOLDED_SHEET, 3000, 1, 1.0, 0.25, 0.0, 1.5}));
  Options options;
  const Report repaired = reconstruct (input, options).report;
  options.remove_self_intersections = false;
  const Report left = reconstruct (input, options).report;
  EXPECT_GT (left.check.self_intersections, 0U);
  EXPECT_EQ (left.statistics.self_intersections_found, left.check.self_intersections);
  EXPECT_EQ (repaired.statistics.self_intersections_found, left.check.self_intersections);
  EXPECT_LT (repaired.check.self_intersections, left.check.self_intersections);
  EXPECT_EQ (left.statistics.self_intersection_flips + left.statistics.remade_points, 0U);
}

// Noise is repaired once, after the points that lie on others are back.
TEST (Finish, NoiseOfStackedPointsIsRepaired)
{
  Positions positions = surface (SurfaceKind::TORUS, 3000, 1.0);
  RandomStream random (7);
  const std::size_t alone = positions.size ();
  for (std::size_t p = 0; p < alone; ++p)
    positions.emplace_back (positions[p] + 0.002 * normalVector (random));
  const Input input = asInput (positions);
  Options options;
  const Report repaired = reconstruct (input, options).report;
  options.remove_self_intersections = false;
  const Report left = reconstruct (input, options).report;
  EXPECT_GT (left.statistics.stacked_points, 2000U);
  EXPECT_GT (left.check.self_intersections, 100U);
  EXPECT_LT (2 * repaired.check.self_intersections, left.check.self_intersections);
}

} // namespace
} // namespace pcl::floater
