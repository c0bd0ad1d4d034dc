// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that cross each other: all are found, and they are removed.
#include "mesh/self_intersections.h"

#include "mesh/flaw_repair.h"
#include "mesh/known_meshes.h"
#include "mesh/trimming.h"
#include "mesh/vertex_stars.h"
#include "report/findings.h"
#include "report/report_mesh.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::beside;
using samples::Mesh;
using samples::Positions;
using samples::sheet;
using samples::torus;

std::vector<CrossingPair>
crossingOf (const Mesh& mesh)
{
  return findSelfIntersections (mesh.triangles, mesh.positions, 1);
}

TEST (SelfIntersections, TwoTrianglesThatShareACornerOrAnEdge)
{
  // A right triangle in z = 0, and another one with some of its corners.
  const auto crosses = [] (const Positions& more, const Triangle& other) {
    Positions all{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    all.insert (all.end (), more.begin (), more.end ());
    return doCross ({0, 1, 2}, other, all);
  };
  // No common corner: through the middle, beside it, and touching by a corner.
  EXPECT_TRUE (crosses ({{0.2, 0.2, -1}, {0.2, 0.2, 1}, {2, 2, 0.5}}, {3, 4, 5}));
  EXPECT_FALSE (crosses ({{2, 2, -1}, {2, 2, 1}, {3, 3, 0.5}}, {3, 4, 5}));
  EXPECT_TRUE (crosses ({{0.25, 0.25, 0}, {0.2, 0.2, 1}, {0.4, 0.2, 1}}, {3, 4, 5}));
  EXPECT_FALSE (crosses ({{0.25, 0.25, 1e-300}, {0.2, 0.2, 1}, {0.4, 0.2, 1}}, {3, 4, 5}));
  // A common corner: the edge opposite to it goes through the triangle, or by.
  EXPECT_TRUE (crosses ({{0.2, 0.2, -1}, {0.2, 0.2, 1}}, {0, 3, 4}));
  EXPECT_FALSE (crosses ({{-0.2, 0.2, -1}, {-0.2, 0.2, 1}}, {0, 3, 4}));
  EXPECT_TRUE (crosses ({{0.5, 0.25, 0}, {0.25, 0.5, 0}}, {3, 4, 0}));
  // A common edge: on the same side in one plane, on the other side, out of the plane.
  EXPECT_TRUE (crosses ({{1, 1, 0}}, {0, 1, 3}));
  EXPECT_FALSE (crosses ({{0, -1, 0}}, {1, 0, 3}));
  EXPECT_FALSE (crosses ({{0, 1, 1e-300}}, {0, 1, 3}));
  // A triangle whose corners lie on one line crosses nothing.
  EXPECT_FALSE (crosses ({{0.2, 0.2, -1}, {0.2, 0.2, 0}, {0.2, 0.2, 1}}, {3, 4, 5}));
}

TEST (SelfIntersections, CleanMeshesHaveNone)
{
  for (const Mesh& mesh : {sheet (1), sheet (30), torus (40, 19), beside (sheet (5), sheet (3))})
    EXPECT_TRUE (crossingOf (mesh).empty ());
  EXPECT_TRUE (findSelfIntersections ({}, {}, 1).empty ());
}

// Triangles with corners anywhere, which cross hundreds of times and share no corner; and fans.
Mesh
randomTriangles (std::size_t triangles, std::size_t fans, std::uint64_t seed)
{
  RandomStream random (seed);
  const auto anywhere = [&random] {
    return Eigen::Vector3d (random.uniform (), random.uniform (), random.uniform ());
  };
  Mesh triangle{{}, {{0, 1, 2}}}, fan, all;
  for (std::size_t t = 0; t < triangles; ++t) {
    triangle.positions = {0.2 * anywhere (), 0.2 * anywhere (), 0.2 * anywhere ()};
    samples::append (all, triangle, anywhere ());
  }
  for (Index i = 0; i < 7; ++i)
    fan.triangles.push_back ({0, 1 + i, 1 + (i + 1) % 7});
  for (std::size_t f = 0; f < fans; ++f) {
    fan.positions.assign (1, Eigen::Vector3d::Zero ());
    for (int i = 0; i < 7; ++i)
      fan.positions.emplace_back (0.2 * (anywhere () - Eigen::Vector3d::Constant (0.5)));
    samples::append (all, fan, anywhere ());
  }
  return all;
}

TEST (SelfIntersections, AllPairsAreFound)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Mesh mesh = randomTriangles (150, 60, seed);
    std::vector<CrossingPair> all;
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (Index u = t + 1; u < mesh.triangles.size (); ++u)
        if (doCross (mesh.triangles[t], mesh.triangles[u], mesh.positions))
          all.push_back ({t, u});
    EXPECT_GT (all.size (), 100U);
    EXPECT_EQ (crossingOf (mesh), all);
  }
}

constexpr Index SWAPPED_SIDE = 8;
constexpr Index SWAPPED_POINTS = (SWAPPED_SIDE + 1) * (SWAPPED_SIDE + 1);

// Two sheets of 0.1 mean spacing; points of the upper one are swapped with those below, so that
// triangles cross.
struct Swapped : samples::TwoSheets
{
  std::vector<float> spacing;

  explicit Swapped (const std::vector<Index>& swapped)
      : TwoSheets (jittered ({0, 0, 0}), jittered ({0.03, 0.04, 0.06}), 30),
        spacing (positions.size (), 0.1F)
  {
    for (const Index p : swapped)
      samples::exchange (mesh, p, p + SWAPPED_POINTS);
  }

  static Mesh jittered (const Eigen::Vector3d& shift)
  {
    Mesh mesh = sheet (SWAPPED_SIDE);
    RandomStream random (SWAPPED_SIDE);
    for (Eigen::Vector3d& p : mesh.positions)
      p += shift + 0.02 * Eigen::Vector3d (random.uniform (), random.uniform (), random.uniform ());
    return mesh;
  }

  std::vector<CrossingPair> crossing () const { return crossingOf ({positions, mesh.triangles}); }

  // Expects two discs of all points, and what is told of the pairs that are left.
  Repairs remove (const RepairLimits& limits = {})
  {
    CrossingPairs pairs = findSelfIntersections (mesh.triangles, positions, 1);
    const Repairs done =
        repairFlaws (mesh, pairs, neighbors, TriangleCost (positions, normals, &spacing), positions,
                     Repair::AT_THE_END, {}, limits, 1);
    EXPECT_EQ (crossing (), pairs);
    samples::expectConsistent (mesh);
    const samples::Topology topology = samples::topologyOf (mesh.triangles);
    EXPECT_EQ (topology.vertices, positions.size ());
    EXPECT_EQ (topology.euler, 2);
    return done;
  }
};

TEST (SelfIntersections, AreRemovedByMovesAndNothingElseChanges)
{
  Swapped sheets ({30, 50});
  EXPECT_GE (sheets.crossing ().size (), 4U);
  const samples::Topology before = samples::topologyOf (sheets.mesh.triangles);
  const Repairs done = sheets.remove ();
  EXPECT_TRUE (sheets.crossing ().empty ());
  EXPECT_GE (done.moves + done.flips, 2U);
  EXPECT_TRUE (samples::foldedEdges (sheets.mesh.triangles, sheets.positions).empty ());
  EXPECT_EQ (samples::topologyOf (sheets.mesh.triangles).loops, before.loops);
}

// Where flips and moves of single points no longer help, patches are taken out and put back.
TEST (SelfIntersections, AreRemovedByPatchesWhereMovesDoNotHelp)
{
  RepairLimits moves_only;
  moves_only.rebuilt_orders = 0;
  std::size_t left_by_moves = 0, left = 0, rebuilds = 0;
  RandomStream random (12);
  for (int round = 0; round < 6; ++round) {
    std::vector<Index> swapped;
    for (Index p = 0; p < SWAPPED_POINTS; ++p)
      if (random.uniform () < 0.2)
        swapped.push_back (p);
    Swapped by_moves (swapped), sheets (swapped);
    by_moves.remove (moves_only);
    left_by_moves += by_moves.crossing ().size ();
    rebuilds += sheets.remove ().rebuilds;
    left += sheets.crossing ().size ();
  }
  EXPECT_GT (rebuilds, 0U);
  EXPECT_LT (left, left_by_moves);
}

// Needles across each other like the threads of a cloth: each overlaps half of all others.
TEST (SelfIntersections, SearchEndsAtItsLimitAndSaysMoreThan)
{
  constexpr Index NEEDLES = 6000;
  Positions positions;
  std::vector<Triangle> triangles;
  for (Index i = 0; i < NEEDLES; ++i) {
    const double at = (i + 0.25) / NEEDLES, width = 0.5 / NEEDLES;
    if (i % 2 == 0) // lying, along y
      positions.insert (positions.end (), {{at, 0, 0}, {at, 1, 0}, {at + width, 1, 0}});
    else // standing, along x
      positions.insert (positions.end (), {{0, at, -1}, {1, at, -1}, {0.5, at, 1}});
    triangles.push_back ({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const CrossingPairs pairs = findSelfIntersections (triangles, positions, 1);
  EXPECT_EQ (pairs, findSelfIntersections (triangles, positions, 2));
  EXPECT_GT (pairs.size (), 0U);
  EXPECT_GT (pairs.untested.size (), NEEDLES / 2);
  const Points points = samples::pointsAt (positions);
  MeshExamination found;
  checkCrossing (triangles, points, 1, found);
  EXPECT_TRUE (found.check.has_more_self_intersections);
  Report report;
  ASSERT_FALSE (reportCheck (points, found, {}, report));
  describeFindings (report);
  EXPECT_NE (testing::PrintToString (report.warnings).find ("more than"), std::string::npos);
  // What was not tested is cut off, too: no two triangles of the rest cross.
  TriangleMesh mesh;
  mesh.triangles = triangles;
  ASSERT_TRUE (mesh.connect (positions.size (), 1));
  TrimmingOptions open;
  open.open_self_intersections = true;
  trimMesh (mesh, points, std::vector<float> (positions.size (), 1.0F), open, 1);
  EXPECT_TRUE (findSelfIntersections (mesh.triangles, positions, 1).empty ());
}

TEST (SelfIntersections, AreInTheReportWithPlaces)
{
  const Swapped sheets ({40});
  const std::vector<Triangle>& triangles = sheets.mesh.triangles;
  const Points points = samples::pointsAt (sheets.positions);
  MeshExamination found;
  checkCrossing (triangles, points, 1, found);
  const std::vector<CrossingPair> pairs = sheets.crossing ();
  ASSERT_FALSE (pairs.empty ());
  const std::vector<std::array<std::uint32_t, 2>>& at = found.check.self_intersections_at;
  ASSERT_EQ (at.size (), std::min<std::size_t> (pairs.size (), 10));
  for (std::size_t i = 0; i < at.size (); ++i) {
    EXPECT_EQ (at[i][0], points.cloud_index[triangles[pairs[i].first][0]]);
    EXPECT_EQ (at[i][1], points.cloud_index[triangles[pairs[i].second][0]]);
  }
  Report report;
  ASSERT_FALSE (reportCheck (points, found, {}, report));
  describeFindings (report);
  EXPECT_NE (testing::PrintToString (report.warnings)
                 .find (std::to_string (pairs.size ()) + " pairs of triangles cross"),
             std::string::npos);
}

} // namespace
} // namespace pcl::floater
