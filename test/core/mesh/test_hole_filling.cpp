// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulation of polygons at least cost, and the filling of holes by it.
#include "mesh/hole_filling.h"

#include "samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using samples::PI;
using samples::Positions;

double
areaOf (const Positions& positions, Index p, Index q, Index r)
{
  return 0.5 * (positions[q] - positions[p]).cross (positions[r] - positions[p]).norm ();
}

// Least area of all triangulations of the corners first to last, by trying all of them.
double
leastArea (const Positions& positions, Index first, Index last)
{
  if (last - first < 2)
    return 0.0;
  double least = std::numeric_limits<double>::infinity ();
  for (Index apex = first + 1; apex < last; ++apex)
    least = std::min (least, areaOf (positions, first, apex, last) +
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
        [&] (Index p, Index q, Index r) { return areaOf (positions, p, q, r); },
        [] (Index, Index) { return true; });
    ASSERT_EQ (triangles.size (), corners < 3 ? 0U : corners - 2);
    if (triangles.empty ())
      continue;
    double area = 0.0;
    for (const Triangle& t : triangles)
      area += areaOf (positions, t[0], t[1], t[2]);
    EXPECT_NEAR (area, leastArea (positions, 0, corners - 1), 1e-12);
    const samples::Topology topology = samples::topologyOf (triangles);
    EXPECT_TRUE (topology.manifold);
    ASSERT_EQ (topology.loops.size (), 1U);
    EXPECT_EQ (topology.loops.front (), samples::indices (corners));
  }
}

TEST (PolygonFilling, UsesAllowedEdgesOnly)
{
  PolygonFilling filling (1);
  const std::vector<Index> square = {3, 5, 7, 9};
  const auto cost = [] (Index, Index, Index) { return 1.0; };
  const auto without = [] (Index a, Index b) {
    return [a, b] (Index p, Index q) { return std::minmax (p, q) != std::minmax (a, b); };
  };
  using Set = std::set<Triangle>;
  EXPECT_EQ (samples::unordered (filling.fill (square, cost, without (3, 7))),
             (Set{{3, 5, 9}, {5, 7, 9}}));
  EXPECT_EQ (samples::unordered (filling.fill (square, cost, without (5, 9))),
             (Set{{3, 5, 7}, {3, 7, 9}}));
  EXPECT_TRUE (filling.fill (square, cost, [] (Index, Index) { return false; }).empty ());
}

// A flat ring of two rows of points, a circle of radius 1 and one of radius 1.2; its triangles, and
// its loops with the inner one first.
struct Ring
{
  Positions positions;
  std::vector<Eigen::Vector3f> normals;
  TriangleMesh mesh;
  std::vector<BoundaryLoop> loops;

  explicit Ring (Index around)
  {
    for (const double radius : {1.0, 1.2})
      for (Index i = 0; i < around; ++i) {
        const double angle = 2.0 * PI * i / around;
        positions.emplace_back (radius * std::cos (angle), radius * std::sin (angle), 0.0);
      }
    normals.assign (positions.size (), Eigen::Vector3f::UnitZ ());
    for (Index i = 0; i < around; ++i) {
      const Index j = (i + 1) % around;
      mesh.triangles.push_back ({i, around + i, around + j});
      mesh.triangles.push_back ({i, around + j, j});
    }
    EXPECT_TRUE (mesh.connect (positions.size (), 1));
    loops = findBoundaryLoops (mesh, findComponents (mesh, 1), positions,
                               std::vector<float> (positions.size (), 0.1F), 1);
    EXPECT_EQ (loops.size (), 2U);
  }
};

void
expectFilled (Index around, const HoleFillingLimits& limits)
{
  SCOPED_TRACE (around);
  Ring ring (around);
  ring.loops[1].keep_open = true;
  const TriangleCost cost (ring.positions, ring.normals);
  EXPECT_EQ (fillHoles (ring.mesh, ring.loops, ring.positions, cost, limits, 1), 1U);
  EXPECT_EQ (ring.mesh.triangles.size (), 3 * around - 2);
  const samples::Topology topology = samples::topologyOf (ring.mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.euler, 1);
  ASSERT_EQ (topology.loops.size (), 1U);
  EXPECT_EQ (topology.loops.front ().size (), around);
  // All faces up, without overlaps: the area is that of the outer polygon.
  double area = 0.0;
  for (const Triangle& t : ring.mesh.triangles) {
    const Eigen::Vector3d normal = (ring.positions[t[1]] - ring.positions[t[0]])
                                       .cross (ring.positions[t[2]] - ring.positions[t[0]]);
    EXPECT_GT (normal.z (), 0.0);
    area += 0.5 * normal.z ();
  }
  EXPECT_NEAR (area, 0.5 * around * 1.44 * std::sin (2.0 * PI / around), 1e-9);
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
  const TriangleCost cost (ring.positions, ring.normals);
  EXPECT_EQ (fillHoles (ring.mesh, ring.loops, ring.positions, cost, {}, 1), 0U);
  EXPECT_EQ (ring.mesh.triangles, before.triangles);
}

TEST (HoleFilling, ALoopThatCannotBeFilledIsKeptOpen)
{
  // Both diagonals of the loop of four points are edges of the mesh already.
  const Positions positions = {{0, 0, 0}, {1, 0, 0},     {1, 1, 0},
                               {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
  TriangleMesh mesh;
  mesh.triangles = {{0, 4, 2}, {1, 5, 3}};
  ASSERT_TRUE (mesh.connect (positions.size (), 1));
  const std::vector<Eigen::Vector3f> normals (positions.size (), Eigen::Vector3f::UnitZ ());
  std::vector<BoundaryLoop> loops (1);
  loops[0].points = {0, 1, 2, 3};
  loops[0].length = 4.0;
  const TriangleCost cost (positions, normals);
  EXPECT_EQ (fillHoles (mesh, loops, positions, cost, {}, 1), 0U);
  EXPECT_TRUE (loops[0].keep_open);
  EXPECT_EQ (mesh.triangles.size (), 2U);
}

// Its loop could be filled by the same triangle only, seen from behind: no manifold.
TEST (HoleFilling, ATriangleOnItsOwnStaysOpen)
{
  const Positions positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const Triangle& triangle : {Triangle{0, 1, 2}, Triangle{2, 0, 1}}) {
    TriangleMesh mesh;
    mesh.triangles = {triangle};
    ASSERT_TRUE (mesh.connect (positions.size (), 1));
    const std::vector<Eigen::Vector3f> normals (positions.size (), Eigen::Vector3f::UnitZ ());
    std::vector<BoundaryLoop> loops (1);
    loops[0].points = {0, 1, 2};
    loops[0].length = 3.4;
    const TriangleCost cost (positions, normals);
    EXPECT_EQ (fillHoles (mesh, loops, positions, cost, {}, 1), 0U);
    EXPECT_TRUE (loops[0].keep_open);
    EXPECT_EQ (mesh.triangles.size (), 1U);
  }
}

// The other loop of three points: around a point whose three triangles are a cone.
TEST (HoleFilling, AConeOfThreeTrianglesIsClosed)
{
  const Positions positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  TriangleMesh mesh;
  mesh.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  ASSERT_TRUE (mesh.connect (positions.size (), 1));
  const std::vector<Eigen::Vector3f> normals (positions.size (), Eigen::Vector3f::UnitZ ());
  std::vector<BoundaryLoop> loops (1);
  loops[0].points = {0, 1, 2};
  loops[0].length = 3.4;
  const TriangleCost cost (positions, normals);
  EXPECT_EQ (fillHoles (mesh, loops, positions, cost, {}, 1), 1U);
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.euler, 2);
}

} // namespace
} // namespace pcl::floater
