// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Edge flips, and the insertion of missing points.
#include "mesh/flips.h"

#include "floater/planar_delaunay.h"
#include "mesh/fold_repair.h"
#include "mesh/insertion.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using samples::Positions;
using samples::Sheet;
using samples::unordered;
using Places = std::vector<Eigen::Vector2d>;

Places
planView (const Positions& positions, double stretch = 1.0)
{
  Places uv;
  for (const Eigen::Vector3d& p : positions)
    uv.emplace_back (p.x (), stretch * p.y ());
  return uv;
}

std::vector<Eigen::Vector3f>
upward (std::size_t count)
{
  std::vector<Eigen::Vector3f> normals (count, Eigen::Vector3f::UnitZ ());
  return normals;
}

// Expects a disc of all points within the sheet's border, with the neighbours that connect ()
// finds.
void
expectDisc (const TriangleMesh& mesh, const Sheet& sheet)
{
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.euler, 1);
  EXPECT_EQ (topology.vertices, sheet.positions.size ());
  ASSERT_EQ (topology.loops.size (), 1U);
  EXPECT_EQ (topology.loops.front (), samples::indices (sheet.border));
  TriangleMesh fresh;
  fresh.triangles = mesh.triangles;
  ASSERT_TRUE (fresh.connect (sheet.positions.size (), 1));
  EXPECT_EQ (fresh.neighbors, mesh.neighbors);
}

// How far a point is inside the circle through the corners of a flat triangle, as a share of the
// squared radius. Negative outside.
double
depthInCircle (const Positions& at, const Triangle& t, Index p)
{
  const Eigen::Vector3d a = at[t[1]] - at[t[0]], b = at[t[2]] - at[t[0]];
  const Eigen::Vector3d centre = (a.squaredNorm () * b - b.squaredNorm () * a).cross (a.cross (b)) /
                                 (2.0 * a.cross (b).squaredNorm ());
  return 1.0 - (at[p] - at[t[0]] - centre).squaredNorm () / centre.squaredNorm ();
}

TEST (Flips, AreDelaunayInThePlane)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Sheet sheet = samples::disc (0.07, seed);
    const std::vector<Index> loop = samples::indices (sheet.border);
    const std::vector<Eigen::Vector3f> normals = upward (sheet.positions.size ());
    TriangleMesh mesh = triangulatePlane (planView (sheet.positions, 0.25), loop);
    const std::set<Triangle> before = unordered (mesh.triangles);
    const std::size_t flips = flipEdges (mesh, TriangleCost (sheet.positions, normals), 1);
    EXPECT_GT (flips, 100U);
    EXPECT_NE (unordered (mesh.triangles), before);
    expectDisc (mesh, sheet);
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const MeshEdge across = mesh.mate ({t, side});
        if (across.triangle != NONE) {
          EXPECT_LT (depthInCircle (sheet.positions, mesh.triangles[t], mesh.corner (across)),
                     1e-6);
        }
      }
    EXPECT_EQ (flipEdges (mesh, TriangleCost (sheet.positions, normals), 1), 0U);
  }
}

TEST (Flips, EndOnStraightLines)
{
  // Rows of a rotated grid. Along the border any two diagonals cost the same, up to rounding.
  Sheet sheet;
  const auto add = [&sheet] (int x, int y) {
    sheet.positions.emplace_back (0.9 * x - 0.3 * y, 0.3 * x + 0.9 * y, 0.1 * x - 0.7 * y);
  };
  const int side = 15;
  for (int i = 0; i < side; ++i)
    add (i, 0);
  for (int i = 0; i < side; ++i)
    add (side, i);
  for (int i = 0; i < side; ++i)
    add (side - i, side);
  for (int i = 0; i < side; ++i)
    add (0, side - i);
  sheet.border = sheet.positions.size ();
  for (int x = 1; x < side; ++x)
    for (int y = 1; y < side; ++y)
      add (x, y);
  // The border is laid on a circle, so that some triangles have all corners on one line.
  Places uv;
  for (std::size_t i = 0; i < sheet.border; ++i) {
    const double angle =
        2.0 * samples::PI * static_cast<double> (i) / static_cast<double> (sheet.border);
    uv.emplace_back (std::cos (angle), std::sin (angle));
  }
  for (int x = 1; x < side; ++x)
    for (int y = 1; y < side; ++y)
      uv.emplace_back (0.05 * (x - 7.5), 0.05 * (y - 7.5));
  TriangleMesh mesh = triangulatePlane (uv, samples::indices (sheet.border));
  std::vector<Eigen::Vector3f> normals (sheet.positions.size (),
                                        Eigen::Vector3d (0.9, 0.3, 0.1)
                                            .cross (Eigen::Vector3d (-0.3, 0.9, -0.7))
                                            .normalized ()
                                            .cast<float> ());
  flipEdges (mesh, TriangleCost (sheet.positions, normals), 1);
  expectDisc (mesh, sheet);
}

TEST (Flips, UnfoldAPair)
{
  const Positions positions = {{0, 0, 0}, {0.5, -0.5, 0}, {1, 0, 0}, {0.5, -0.2, 0}};
  TriangleMesh mesh;
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  ASSERT_TRUE (mesh.connect (4, 1));
  EXPECT_EQ (findFolds (mesh, positions, 1).size (), 1U);
  const std::vector<Eigen::Vector3f> normals = upward (4);
  EXPECT_EQ (flipEdges (mesh, TriangleCost (positions, normals), 1), 1U);
  EXPECT_TRUE (findFolds (mesh, positions, 1).empty ());
  EXPECT_EQ (unordered (mesh.triangles), (std::set<Triangle>{{0, 1, 3}, {1, 2, 3}}));
}

TEST (Insertion, PutsEveryPointIn)
{
  const Sheet sheet = samples::disc (0.07, 7);
  const samples::Neighborhoods made = samples::makeNeighborhoods (sheet.positions);
  const Positions& positions = made.points.positions;
  const std::vector<Eigen::Vector3f> normals = upward (positions.size ());
  std::vector<Index> loop (sheet.border);
  for (Index p = 0; p < positions.size (); ++p)
    if (made.points.cloud_index[p] < sheet.border)
      loop[made.points.cloud_index[p]] = p;
  Places some = planView (positions);
  RandomStream random (8);
  std::size_t missing = 0;
  for (std::size_t p = 0; p < some.size (); ++p)
    if (made.points.cloud_index[p] >= sheet.border && random.uniform () < 0.2) {
      some[p].setConstant (std::numeric_limits<double>::quiet_NaN ());
      ++missing;
    }
  TriangleMesh mesh = triangulatePlane (some, loop);
  const TriangleCost cost (positions, normals);
  EXPECT_EQ (insertMissingPoints (mesh, made.geometry.neighbors, cost, false, 1), missing);
  EXPECT_EQ (std::count (mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE), 0);
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.euler, 1);
  EXPECT_EQ (insertMissingPoints (mesh, made.geometry.neighbors, cost, false, 1), 0U);
  EXPECT_EQ (samples::topologyOf (mesh.triangles).loops.size (), 1U);
}

TEST (Insertion, ARowOfPointsFindsItsWayIn)
{
  // Point 3 has only the missing point 4 as a neighbour, point 4 only point 5.
  const Positions positions = {{0, 0, 0},   {10, 0, 0},  {0, 10, 0},
                               {3, 3.1, 0}, {2, 2.3, 0}, {2.5, 1.5, 0}};
  const std::vector<Eigen::Vector3f> normals = upward (6);
  CsrLists neighbors;
  neighbors.offsets = {0, 0, 0, 0, 1, 2, 3};
  neighbors.ids = {4, 5, 0};
  TriangleMesh mesh;
  mesh.triangles = {{0, 1, 2}};
  ASSERT_TRUE (mesh.connect (6, 1));
  EXPECT_EQ (insertMissingPoints (mesh, neighbors, TriangleCost (positions, normals), false, 1),
             3U);
  EXPECT_TRUE (samples::topologyOf (mesh.triangles).manifold);
  EXPECT_EQ (mesh.triangles.size (), 7U);
}

TEST (Insertion, PointsWithoutVerticesNearbyStayOut)
{
  const Positions positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 0}, {9, 8, 0}};
  const std::vector<Eigen::Vector3f> normals = upward (5);
  CsrLists neighbors;
  neighbors.offsets = {0, 0, 0, 0, 1, 2};
  neighbors.ids = {4, 3};
  TriangleMesh mesh;
  mesh.triangles = {{0, 1, 2}};
  ASSERT_TRUE (mesh.connect (5, 1));
  EXPECT_EQ (insertMissingPoints (mesh, neighbors, TriangleCost (positions, normals), false, 1),
             0U);
  EXPECT_EQ (mesh.triangle_of[3], NONE);
  EXPECT_EQ (mesh.triangles.size (), 1U);
}

TEST (TriangleCost, DoesNotDependOnTheFirstCorner)
{
  RandomStream random (12);
  for (int i = 0; i < 2000; ++i) {
    const double flatness = i % 2 == 0 ? 1.0 : 1e-8; // every other triangle is a needle
    Positions positions;
    for (int corner = 0; corner < 3; ++corner)
      positions.emplace_back (random.uniform (), flatness * random.uniform (), 0.0);
    const std::vector<Eigen::Vector3f> normals = upward (3);
    const TriangleCost cost (positions, normals);
    EXPECT_EQ (cost (0, 1, 2), cost (1, 2, 0));
    EXPECT_EQ (cost (0, 1, 2), cost (2, 0, 1));
    EXPECT_EQ (cost (0, 2, 1), cost (2, 1, 0));
  }
}

// Points that differ by less than squares can tell, and whose spacing is 0 as a float.
TEST (TriangleCost, IsFiniteHoweverNearThePointsAre)
{
  const Positions positions{{0.0, 0.0, 0.0},     {1e-200, 0.0, 0.0}, {0.0, 1e-200, 0.0},
                            {2e-200, 3e-200, 0}, {1.0, 0.0, 0.0},    {0.0, 1.0, 0.0}};
  const std::vector<Eigen::Vector3f> normals = upward (positions.size ());
  const std::vector<float> spacing (positions.size (), 0.0F);
  const TriangleCost cost (positions, normals, &spacing);
  for (Index a = 0; a < positions.size (); ++a)
    for (Index b = 0; b < positions.size (); ++b)
      for (Index c = 0; c < positions.size (); ++c)
        if (a != b && b != c && c != a) {
          EXPECT_TRUE (std::isfinite (cost (a, b, c))) << a << b << c;
          EXPECT_GT (cost (a, b, c), 0.0) << a << b << c;
        }
  // Flips end there, too.
  TriangleMesh mesh;
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}, {3, 1, 4}, {2, 3, 5}, {3, 4, 5}};
  ASSERT_TRUE (mesh.connect (positions.size (), 1));
  EXPECT_LT (flipEdges (mesh, cost, 1), 10U);
}

} // namespace
} // namespace pcl::floater
