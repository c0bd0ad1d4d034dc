// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulation of polygons at least cost, and the filling of holes by it.
#include "mesh/hole_filling.h"

#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using samples::PI;
using samples::Positions;

// Least area of all triangulations of the corners first to last, by trying all of them.
double
leastArea (const Positions& positions, Index first, Index last)
{
  if (last - first < 2)
    return 0.0;
  double least = std::numeric_limits<double>::infinity ();
  for (Index apex = first + 1; apex < last; ++apex)
    least = std::min (least, samples::areaOf (Triangle{first, apex, last}, positions) +
                                 leastArea (positions, first, apex) +
                                 leastArea (positions, apex, last));
  return least;
}

TEST (PolygonFilling, IsTheBestOfAllTriangulations)
{
  PolygonFilling filling (1);
  for (Index corners = 0; corners < 10; ++corners) {
    const Positions positions = samples::randomPoints (corners, corners);
    const std::vector<Triangle> triangles = filling.fill (
        samples::indices (corners),
        [&] (Index p, Index q, Index r) {
          return samples::areaOf (Triangle{p, q, r}, positions);
        },
        [] (Index, Index) { return true; });
    ASSERT_EQ (triangles.size (), corners < 3 ? 0U : corners - 2);
    if (triangles.empty ())
      continue;
    EXPECT_NEAR (samples::areaOf (triangles, positions), leastArea (positions, 0, corners - 1),
                 1e-12);
    EXPECT_EQ (samples::expectDisc (samples::connected (triangles, corners), corners),
               samples::indices (corners));
  }
}

// A flat ring of two rows of points, a circle of radius 1.2 and one of radius 1; its triangles, and
// its loops with the inner one last.
struct Ring
{
  Positions positions;
  std::vector<Eigen::Vector3f> normals;
  TriangleMesh mesh;
  std::vector<BoundaryLoop> loops;

  explicit Ring (Index around)
  {
    const samples::Mesh ring = samples::cells (
        around, 1,
        [=] (Index x, Index y) {
          const double angle = 2.0 * PI * x / around, radius = y == 0 ? 1.2 : 1.0;
          return Eigen::Vector3d (radius * std::cos (angle), radius * std::sin (angle), 0.0);
        },
        true);
    positions = ring.positions;
    normals.assign (positions.size (), Eigen::Vector3f::UnitZ ());
    mesh = samples::connected (ring);
    loops = findBoundaryLoops (mesh, findComponents (mesh, 1), positions,
                               std::vector<float> (positions.size (), 0.1F), 1);
    EXPECT_EQ (loops.size (), 2U);
  }

  std::size_t fill (const HoleFillingLimits& limits = {})
  {
    return fillHoles (mesh, loops, positions, TriangleCost (positions, normals), limits, 1);
  }
};

void
expectFilled (Index around, const HoleFillingLimits& limits)
{
  SCOPED_TRACE (around);
  Ring ring (around);
  ring.loops[0].keep_open = true;
  EXPECT_EQ (ring.fill (limits), 1U);
  EXPECT_EQ (ring.mesh.triangles.size (), 3 * around - 2);
  EXPECT_EQ (samples::expectDisc (ring.mesh, 2 * around), samples::indices (around));
  // All faces up, without overlaps: the area is that of the outer polygon.
  for (const auto& [a, b, c] : ring.mesh.triangles)
    EXPECT_GT (areaVector (ring.positions[a], ring.positions[b], ring.positions[c]).z (), 0.0);
  EXPECT_NEAR (samples::areaOf (ring.mesh.triangles, ring.positions),
               0.5 * around * 1.44 * std::sin (2.0 * PI / around), 1e-9);
}

TEST (HoleFilling, FillsLoopsOfAnySize)
{
  for (const Index around : {3U, 12U, 128U, 129U, 300U})
    expectFilled (around, {});
  HoleFillingLimits ears_only;
  ears_only.largest_polygon = 3;
  expectFilled (40, ears_only);
}

TEST (HoleFilling, LoopsThatAreKeptOpenStay)
{
  Ring ring (12);
  ring.loops[0].keep_open = ring.loops[1].keep_open = true;
  const TriangleMesh before = ring.mesh;
  EXPECT_EQ (ring.fill (), 0U);
  samples::expectSame (ring.mesh, before);
}

TEST (HoleFilling, NoLidLiesOnAFlatSurface)
{
  Ring ring (40);
  ring.loops[1].keep_open = true;
  const TriangleMesh before = ring.mesh;
  EXPECT_EQ (ring.fill (), 0U);
  EXPECT_TRUE (ring.loops[0].keep_open);
  samples::expectSame (ring.mesh, before);
}

// Fills a loop of the first points of a mesh, or keeps it open; returns its triangles.
std::vector<Triangle>
filled (const std::vector<Triangle>& triangles, std::size_t loop, bool can_be_filled)
{
  const Positions positions = {{0, 0, 0}, {1, 0, 0},     {1, 1, 0},
                               {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
  TriangleMesh mesh = samples::connected (triangles, positions.size ());
  const std::vector<Eigen::Vector3f> normals (positions.size (), Eigen::Vector3f::UnitZ ());
  std::vector<BoundaryLoop> loops (1);
  loops[0].points = samples::indices (loop);
  loops[0].length = 4.0;
  const TriangleCost cost (positions, normals);
  EXPECT_EQ (fillHoles (mesh, loops, positions, cost, {}, 1), can_be_filled ? 1U : 0U);
  EXPECT_EQ (loops[0].keep_open, !can_be_filled);
  samples::expectConsistent (mesh);
  return mesh.triangles;
}

TEST (HoleFilling, ALoopThatCannotBeFilledIsKeptOpen)
{
  // Both diagonals of the loop of four points are edges of the mesh already.
  const std::vector<Triangle> diagonals{{0, 4, 2}, {1, 5, 3}};
  EXPECT_EQ (filled (diagonals, 4, false), diagonals);
  // Of a triangle on its own, the same one seen from behind would be no manifold.
  for (const Triangle& triangle : {Triangle{0, 1, 2}, Triangle{2, 0, 1}})
    EXPECT_EQ (filled ({triangle}, 3, false), std::vector<Triangle>{triangle});
  // But around a point whose three triangles are a cone, it closes them.
  EXPECT_EQ (samples::topologyOf (filled ({{0, 1, 4}, {1, 2, 4}, {2, 0, 4}}, 3, true)).euler, 2);
}

} // namespace
} // namespace pcl::floater
