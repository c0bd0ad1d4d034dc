// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulation of polygons at least cost, and the filling of holes by it, also between other sheets; what is taken out at the boundary: folds
// beside it, and triangles that only fill its notches.
#include "mesh/hole_filling.h"

#include "mesh/finish.h"
#include "mesh/known_meshes.h"
#include "mesh/open_boundary.h"
#include "mesh/trimming.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

// Least area of all triangulations of the corners first to last, by trying all of them.
double
leastArea (const Positions& positions, Index first, Index last)
{
  if (last - first < 2)
    return 0.0;
  double least = std::numeric_limits<double>::infinity ();
  for (Index apex = first + 1; apex < last; ++apex)
    least = std::min (least, areaOf (Triangle{first, apex, last}, positions) +
                                 leastArea (positions, first, apex) +
                                 leastArea (positions, apex, last));
  return least;
}

TEST (PolygonFilling, IsTheBestOfAllTriangulations)
{
  PolygonFilling filling (1);
  for (Index corners = 0; corners < 10; ++corners) {
    const Positions positions = randomPoints (corners, corners);
    const std::vector<Triangle> triangles = filling.fill (
        indices (corners),
        [&] (Index p, Index q, Index r) {
          return areaOf (Triangle{p, q, r}, positions);
        },
        [] (Index, Index) { return true; });
    ASSERT_EQ (triangles.size (), corners < 3 ? 0U : corners - 2);
    if (triangles.empty ())
      continue;
    EXPECT_NEAR (areaOf (triangles, positions), leastArea (positions, 0, corners - 1), 1e-12);
    EXPECT_EQ (expectDisc (connected (triangles, corners), corners), indices (corners));
  }
}

// A flat ring of two rows of points, a circle of radius 1.2 and one of radius 1: its second loop.
Mesh
ringOf (Index around)
{
  return cells (
      around, 1,
      [=] (Index x, Index y) { return polar (y == 0 ? 1.2 : 1.0, 2.0 * PI * x / around); }, true);
}

std::size_t
fill (UprightMesh& made)
{
  return fillHoles (made.mesh, made.loops, made.positions,
                    TriangleCost (made.positions, made.normals), 1);
}

TEST (HoleFilling, FillsLoopsOfAnySize)
{
  for (const Index around : {3U, 12U, 40U, 128U, 129U, 300U}) {
    SCOPED_TRACE (around);
    UprightMesh ring (ringOf (around));
    ring.loops[0].keep_open = true;
    EXPECT_EQ (fill (ring), 1U);
    EXPECT_EQ (ring.mesh.triangles.size (), 3 * around - 2);
    EXPECT_EQ (expectDisc (ring.mesh, 2 * around), indices (around));
    // All faces up, without overlaps: the area is that of the outer polygon.
    for (const auto& [a, b, c] : ring.mesh.triangles)
      EXPECT_GT (areaVector (ring.positions[a], ring.positions[b], ring.positions[c]).z (), 0.0);
    EXPECT_NEAR (areaOf (ring.mesh.triangles, ring.positions),
                 0.5 * around * 1.44 * std::sin (2.0 * PI / around), 1e-9);
  }
}

TEST (HoleFilling, LoopsThatAreToStayOpenDo)
{
  UprightMesh ring (ringOf (40));
  ring.loops[0].keep_open = ring.loops[1].keep_open = true;
  const TriangleMesh before = ring.mesh;
  EXPECT_EQ (fill (ring), 0U);
  expectSame (ring.mesh, before);
}

TEST (HoleFilling, ALoopThatCannotBeFilledIsKeptOpen)
{
  const Positions positions = {{0, 0, 0}, {1, 0, 0},     {1, 1, 0},
                               {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
  const std::vector<Eigen::Vector3f> normals (positions.size (), Eigen::Vector3f::UnitZ ());
  // Fills a loop of the first points of a mesh, or keeps it open; returns its triangles.
  const auto filled = [&] (const Triangles& triangles, std::size_t loop, bool can_be_filled) {
    TriangleMesh mesh = connected (triangles, positions.size ());
    std::vector<BoundaryLoop> loops (1);
    loops[0].points = indices (loop);
    loops[0].length = 4.0;
    const TriangleCost cost (positions, normals);
    EXPECT_EQ (fillHoles (mesh, loops, positions, cost, 1), can_be_filled ? 1U : 0U);
    EXPECT_EQ (loops[0].keep_open, !can_be_filled);
    expectConsistent (mesh);
    return mesh.triangles;
  };
  // Both diagonals of the loop of four points are edges of the mesh already.
  const std::vector<Triangle> diagonals{{0, 4, 2}, {1, 5, 3}};
  EXPECT_EQ (filled (diagonals, 4, false), diagonals);
  // Of a triangle on its own, the same one seen from behind would be no manifold.
  for (const Triangle& triangle : {Triangle{0, 1, 2}, Triangle{2, 0, 1}})
    EXPECT_EQ (filled ({triangle}, 3, false), std::vector<Triangle>{triangle});
  // But around a point whose three triangles are a cone, it closes them.
  EXPECT_EQ (topologyOf (filled ({{0, 1, 4}, {1, 2, 4}, {2, 0, 4}}, 3, true)).euler, 2);
}

TEST (HoleFilling, OnlyTrianglesThatFitAreTaken)
{
  for (const Index around : {12U, 140U}) {
    UprightMesh ring (ringOf (around));
    ring.loops[0].keep_open = true;
    const Index apex = ring.loops[1].points[5];
    const TriangleCost cost (ring.positions, ring.normals);
    TriangleMesh mesh = ring.mesh;
    EXPECT_EQ (fillHoles (mesh, ring.loops, ring.positions, cost, 1,
                          [=] (const Triangle& t) { return isCorner (t, apex); }),
               1U);
    EXPECT_EQ (mesh.triangles.size (), 3 * around - 2);
    for (std::size_t t = 2 * around; t < mesh.triangles.size (); ++t)
      EXPECT_TRUE (isCorner (mesh.triangles[t], apex));
    EXPECT_EQ (fillHoles (ring.mesh, ring.loops, ring.positions, cost, 1,
                          [] (const Triangle&) { return false; }),
               0U);
    EXPECT_TRUE (ring.loops[1].keep_open);
  }
}

// A mesh, one loop of which is filled across another sheet.
struct Crossed : UprightMesh
{
  std::size_t before = mesh.triangles.size ();
  Triangles filled;
  CrossingPairs pairs;
  Flags is_crossing; // of each point

  // \param ring with two loops, the second of which is filled
  Crossed (const Mesh& ring, const Mesh& sheet)
      : UprightMesh (beside (ring, sheet, {0.0, 0.0, 0.0}))
  {
    EXPECT_EQ (loops.size (), 3U);
    loops[0].keep_open = loops[2].keep_open = true;
    EXPECT_EQ (fill (*this), 1U);
    filled = mesh.triangles;
    pairs = findSelfIntersections (mesh.triangles, positions, 1);
    is_crossing.assign (positions.size (), 0);
    for (const CrossingPair& pair : pairs)
      for (const Index t : {pair.first, pair.second})
        for (const Index p : mesh.triangles[t])
          is_crossing[p] = 1;
  }

  TriangleMesh refilled (Flags& is_chosen, bool may_stay_open)
  {
    return refillCrossed (filled, before, loops, is_chosen, may_stay_open, positions,
                          TriangleCost (positions, normals), 1);
  }
};

// A ring, the hole of which has a sheet in it.
struct Pierced : Crossed
{
  Pierced ()
      : Crossed (ringOf (16), cells (8, 8, [] (Index x, Index y) {
                   return Eigen::Vector3d (x / 8.0 - 0.5, 0.01, y / 8.0 - 0.5);
                 }))
  {
  }
};

TEST (CrossedFillings, AHoleWithASheetInItStaysOpenIfItMay)
{
  Pierced crossed;
  for (const Flags& chosen : {crossed.is_crossing, Flags (crossed.positions.size (), 0)})
    for (const bool may_stay_open : {false, true}) {
      Flags is_chosen = chosen;
      const bool opens = may_stay_open && chosen == crossed.is_crossing;
      EXPECT_EQ (crossed.refilled (is_chosen, may_stay_open).triangles.size (),
                 opens ? crossed.before : 0);
      EXPECT_EQ (crossed.loops[1].keep_open, opens);
      EXPECT_EQ (crossed.loops[1].judgement.is_too_deep, opens);
      EXPECT_EQ (std::count (is_chosen.begin (), is_chosen.end (), 1), opens ? 16 : 0);
      crossed.loops[1].keep_open = crossed.loops[1].judgement.is_too_deep = false;
    }
}

// Another mesh is asked for where triangles still cross.
TEST (CrossedFillings, AreReplacedInTheFinish)
{
  for (const bool has_other : {false, true}) {
    Pierced crossed;
    LocalGeometry geometry;
    geometry.neighbors = nearestOf (crossed.positions, 20);
    geometry.stars.normals = crossed.normals;
    geometry.spacing.assign (crossed.positions.size (), 0.3F);
    FinishSettings settings;
    settings.repair = true;
    if (has_other)
      settings.other = [&] (Flags& is_chosen) { return crossed.refilled (is_chosen, true); };
    const MeshFinish finish = finishMesh (crossed.mesh, crossed.positions, geometry, settings, 1);
    EXPECT_EQ (finish.crossing->empty (), has_other);
    EXPECT_EQ (crossed.loops[1].keep_open, has_other);
    expectTopology (crossed.mesh.triangles, crossed.positions.size (), 2, has_other ? 1 : 2,
                    has_other ? 3 : 2);
  }
}

// Four points that are high and low in turn may be filled by a ridge or by a valley.
TEST (CrossedFillings, AnotherFillingLeavesTheSheetAlone)
{
  const Mesh saddle = cells (
      4, 1,
      [] (Index x, Index y) {
        Eigen::Vector3d p = polar (y == 0 ? 2.0 : 1.0, 2.0 * PI * x / 4);
        p.z () = x % 2 == 0 ? 0.5 : -0.5;
        return p;
      },
      true);
  std::size_t crossing = 0;
  for (const double side : {1.0, -1.0}) {
    Crossed crossed (saddle, cells (4, 4, [=] (Index x, Index y) {
                       return Eigen::Vector3d (0.02 * x - 0.03, 0.02 * x - 0.05,
                                               side * (0.1 + 0.2 * y));
                     }));
    const TriangleMesh other = crossed.refilled (crossed.is_crossing, true);
    EXPECT_EQ (other.triangles.empty (), crossed.pairs.empty ());
    if (other.triangles.empty ())
      continue;
    ++crossing;
    EXPECT_EQ (other.triangles.size (), crossed.mesh.triangles.size ());
    EXPECT_TRUE (findSelfIntersections (other.triangles, crossed.positions, 1).empty ());
    EXPECT_FALSE (crossed.loops[1].keep_open);
    expectConsistent (other);
  }
  EXPECT_EQ (crossing, 1U);
}

// Equilateral triangles; rows of points, each shifted by half a triangle against the one before.
Mesh
honeycomb (Index columns, Index rows)
{
  Mesh mesh = cells (columns, rows, [] (Index x, Index y) {
    return Eigen::Vector3d (x + (y % 2 == 0 ? 0.0 : 0.5), y * std::sqrt (0.75), 0.0);
  });
  for (std::size_t t = 0; t < mesh.triangles.size (); t += 2)
    if (t / 2 / columns % 2 == 0) { // the other diagonal
      const auto [a, b, d] = mesh.triangles[t];
      const Index c = mesh.triangles[t + 1][2];
      mesh.triangles[t] = {a, b, c};
      mesh.triangles[t + 1] = {b, d, c};
    }
  return mesh;
}

TEST (OpenBoundary, FlatAndClosedMeshesStay)
{
  for (const Mesh& mesh : {sheet (9), honeycomb (8, 7), annulus (12), torus (9, 7), Mesh ()}) {
    TriangleMesh changed = connected (mesh);
    openBoundaryFolds (changed, mesh.positions, 1);
    openNotches (changed, mesh.positions, 1);
    EXPECT_EQ (changed.triangles, mesh.triangles);
  }
}

TEST (BoundaryFolds, AsManyTrianglesBesideTheBoundaryAreTakenOutAsItNeeds)
{
  // A fan at the boundary point 0, whose second triangle is folded against the third one, so that
  // one triangle is not enough. Points 2 to 4 are inside.
  const Positions places{{0, 0, 0},         {-1.3, -0.4, 2.1}, {-1.2, 0.2, 0.3}, {0.1, 0.7, 0.1},
                         {-2.2, -0.1, 0.3}, {-1, -0.5, 1.1},   {-3.5, 0.4, 0.8}, {-1.1, 0.6, 0.2}};
  const Triangles fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {2, 1, 7},
                      {3, 2, 7}, {4, 3, 6}, {5, 4, 6}, {3, 7, 6}};
  // Squares of a strip of two rows, cut along diagonals; two triangles are turned over, as
  // an inner point is moved across the boundary. Point x of row y is 7 y + x.
  Mesh strip = cells (6, 2, [] (Index x, Index y) { return Eigen::Vector3d (x, y, 0.0); });
  strip.positions[10] = {3.0, -0.5, 0.0};
  for (const Mesh& mesh : {strip, Mesh{places, fan}}) {
    TriangleMesh changed = connected (mesh);
    ASSERT_GT (findFolds (changed, mesh.positions, 1).size (), 0U);
    // All folds end, no point is lost, and one boundary loop is left.
    openBoundaryFolds (changed, mesh.positions, 1);
    EXPECT_EQ (changed.triangles.size (), mesh.triangles.size () - 2);
    EXPECT_EQ (findFolds (changed, mesh.positions, 1).size (), 0U);
    expectDisc (changed, mesh.positions.size ());
  }
}

TEST (BoundaryCrossings, TrianglesThatTheBoundaryMayDoWithoutAreChosen)
{
  const Mesh floor = cells (8, 8, [] (Index x, Index y) { return Eigen::Vector3d (x, y, 0.0); });
  // A wall through the middle of the floor; and a sheet above it with a triangle that reaches through it.
  const Mesh wall =
      cells (4, 4, [] (Index x, Index y) { return Eigen::Vector3d (2.1 + x, 4.3, y - 1.6); });
  Mesh with_ear =
      cells (2, 2, [] (Index x, Index y) { return Eigen::Vector3d (x + 3, y + 3, 1.0); });
  with_ear.positions.emplace_back (3.4, 3.3, -1.0);
  with_ear.triangles.push_back ({1, 0, static_cast<Index> (with_ear.positions.size () - 1)});
  for (const auto& [other, lost] : {std::make_pair (wall, 0), std::make_pair (with_ear, 1)}) {
    Mesh both = floor;
    append (both, other);
    TriangleMesh mesh = connected (both);
    const CrossingPairs pairs = findSelfIntersections (mesh.triangles, both.positions, 1);
    ASSERT_FALSE (pairs.empty ());
    const Flags chosen = chooseCrossingAtBoundary (mesh, pairs);
    ASSERT_EQ (chosen.size (), mesh.triangles.size ());
    removeTriangles (mesh, chosen, 1);
    expectConsistent (mesh);
    EXPECT_EQ (findComponents (mesh, 1).count, 2U);
    EXPECT_EQ (boundaryLoops (mesh, 1).size (), 2U);
    EXPECT_EQ (std::count (mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE), lost);
    EXPECT_LT (findSelfIntersections (mesh.triangles, both.positions, 1).size (), pairs.size ());
  }
  // Triangles inside are not.
  EXPECT_TRUE (chooseCrossingAtBoundary (connected (torus (9, 7)), {{0, 1}}).empty ());
}

TEST (BoundaryNotches, FillingsAreTakenOut)
{
  constexpr Index COLUMNS = 20, ROWS = 12;
  const Mesh mesh = honeycomb (COLUMNS, ROWS);
  Mesh filled = mesh;
  for (Index y = 1; y < ROWS; ++y) {
    const Index first = y * (COLUMNS + 1), last = first + COLUMNS;
    if (y % 2 == 1)
      filled.triangles.push_back ({first, first + COLUMNS + 1, first - COLUMNS - 1});
    else
      filled.triangles.push_back ({last, last - COLUMNS - 1, last + COLUMNS + 1});
  }
  TriangleMesh changed = connected (filled);
  openNotches (changed, filled.positions, 1);
  EXPECT_EQ (changed.triangles, mesh.triangles);
}

// A sphere of uneven points, triangulated as a whole, and then cut: what is made of the points
// above the cut is the part of the mesh there.
TEST (BoundaryNotches, CutSurfacesEndWhereTheyAreCut)
{
  RandomStream random (5);
  Positions sphere = evenSphere (4000), above;
  for (Eigen::Vector3d& p : sphere)
    p = (p + 0.008 * normalVector (random)).normalized ();
  const auto isAbove = [&] (Index p) { return sphere[p].z () + 0.3 * sphere[p].x () > -0.4; };
  for (Index p = 0; p < sphere.size (); ++p)
    if (isAbove (p))
      above.push_back (sphere[p]);
  const Result whole = reconstruct (asInput (sphere), Options ());
  ASSERT_TRUE (whole.report.check.loops.empty ());
  double expected = 0.0;
  for (const Triangle& t : whole.triangles)
    if (std::all_of (t.begin (), t.end (), isAbove))
      expected += areaOf (t, sphere);
  const Result part = reconstruct (asInput (above), Options ());
  EXPECT_EQ (part.report.check.loops.size (), 1U);
  EXPECT_NEAR (areaOf (part.triangles, above) / expected, 1.0, 0.0015);
}

} // namespace
} // namespace pcl::floater
