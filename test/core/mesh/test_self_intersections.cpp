// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that cross each other: all are found and told; what is cut off on request.
#include "mesh/self_intersections.h"

#include "mesh/crossing_table.h"
#include "mesh/known_meshes.h"
#include "mesh/trimming.h"
#include "report/findings.h"
#include "report/report_mesh.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

std::vector<CrossingPair>
crossingOf (const Mesh& mesh)
{
  return findSelfIntersections (mesh.triangles, mesh.positions, 1);
}

TEST (SelfIntersections, TwoTrianglesThatShareACornerOrAnEdge)
{
  // A right triangle in z = 0, and another one with some of its corners.
  const auto crosses = [] (const Positions& more, const Triangle& other) {
    return doCross ({0, 1, 2}, other, joined ({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, more));
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

// Triangles with corners anywhere, which cross hundreds of times and share no corner; and fans.
TEST (SelfIntersections, AllPairsAreFound)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random (seed);
    const auto anywhere = [&random] { return uniformVector (random); };
    Mesh triangle{{}, {{0, 1, 2}}}, fan, mesh;
    for (int t = 0; t < 150; ++t) {
      triangle.positions = {0.2 * anywhere (), 0.2 * anywhere (), 0.2 * anywhere ()};
      append (mesh, triangle, anywhere ());
    }
    for (Index i = 0; i < 7; ++i)
      fan.triangles.push_back ({0, 1 + i, 1 + (i + 1) % 7});
    for (int f = 0; f < 60; ++f) {
      fan.positions.assign (1, Eigen::Vector3d::Zero ());
      for (int i = 0; i < 7; ++i)
        fan.positions.emplace_back (0.2 * (anywhere () - Eigen::Vector3d::Constant (0.5)));
      append (mesh, fan, anywhere ());
    }
    std::vector<CrossingPair> all;
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (Index u = t + 1; u < mesh.triangles.size (); ++u)
        if (doCross (mesh.triangles[t], mesh.triangles[u], mesh.positions))
          all.push_back ({t, u});
    EXPECT_GT (all.size (), 100U);
    EXPECT_EQ (crossingOf (mesh), all);
    // A third of the triangles come, and one goes; the others were turned and in another order.
    Triangles before (mesh.triangles.rbegin () + 150, mesh.triangles.rend ());
    for (Triangle& t : before)
      std::swap (t[0], t[1]);
    before.push_back ({0, 4, 8});
    const CrossingPairs known = findSelfIntersections (before, mesh.positions, 1);
    EXPECT_EQ (pairsAfterChange (connected (mesh), mesh.positions, before, known, 1), all);
  }
}

// All warnings on a mesh.
std::string
warningOf (const Points& points, const std::vector<Triangle>& triangles,
           const MeshExamination& found)
{
  Report report;
  EXPECT_FALSE (reportMesh (points, triangles, found, {}, {}, {}, report));
  describeFindings (report);
  return testing::PrintToString (report.warnings);
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
  const Points points = pointsAt (positions);
  MeshExamination found;
  checkCrossing (triangles, points, 1, found);
  EXPECT_TRUE (found.check.has_more_self_intersections);
  EXPECT_NE (warningOf (points, triangles, found).find ("more than"), std::string::npos);
  // What was not tested is cut off, too: no two triangles of the rest cross.
  TriangleMesh mesh = connected (triangles, positions.size ());
  trimMesh (mesh, points, std::vector<float> (positions.size (), 1.0F), {0.0, 0.0, true, 0}, 1);
  EXPECT_TRUE (findSelfIntersections (mesh.triangles, positions, 1).empty ());
}

// A sheet, and another one that stands upright in it.
Mesh
crossedSheets ()
{
  Mesh mesh = sheet (10);
  append (mesh, cells (10, 10, [] (Index x, Index y) {
            return Eigen::Vector3d (0.1 * x + 0.013, 0.47, 0.1 * y - 0.52);
          }));
  return mesh;
}

TEST (SelfIntersections, AreInTheReportWithPlaces)
{
  const Mesh mesh = crossedSheets ();
  const Points points = pointsAt (mesh.positions);
  MeshExamination found;
  checkCrossing (mesh.triangles, points, 1, found);
  const std::vector<CrossingPair> pairs = crossingOf (mesh);
  ASSERT_GT (pairs.size (), 10U);
  const std::vector<std::array<std::uint32_t, 2>>& at = found.check.self_intersections_at;
  ASSERT_EQ (at.size (), 10U);
  for (std::size_t i = 0; i < at.size (); ++i) {
    EXPECT_EQ (at[i][0], points.cloud_index[mesh.triangles[pairs[i].first][0]]);
    EXPECT_EQ (at[i][1], points.cloud_index[mesh.triangles[pairs[i].second][0]]);
  }
  EXPECT_NE (warningOf (points, mesh.triangles, found)
                 .find (std::to_string (pairs.size ()) + " pairs of triangles cross"),
             std::string::npos);
}

// The longest edge, also in spacings, and the smallest component.
TrimmingOptions
limits (double length, double spacings = 0.0, int points = 0)
{
  return {length, spacings, false, points};
}

// Trims a mesh whose spacing is 0.1, and whose unit of length is 10 units of the cloud.
Trimming
trim (Mesh& mesh, const TrimmingOptions& options)
{
  TriangleMesh connected = samples::connected (mesh);
  const Trimming trimming =
      trimMesh (connected, pointsAt (mesh.positions),
                std::vector<float> (mesh.positions.size (), 0.1F), options, 1);
  EXPECT_EQ (trimming.triangles, mesh.triangles.size () - connected.triangles.size ());
  // Points that were vertices and are none now.
  std::set<Index> lost;
  for (const Triangle& t : mesh.triangles)
    lost.insert (t.begin (), t.end ());
  for (const Triangle& t : connected.triangles)
    for (const Index p : t)
      lost.erase (p);
  EXPECT_EQ (trimming.points, (std::vector<Index> (lost.begin (), lost.end ())));
  const std::set<Triangle> before = unordered (mesh.triangles);
  for (const Triangle& t : unordered (connected.triangles))
    EXPECT_EQ (before.count (t), 1U);
  mesh.triangles = connected.triangles;
  expectConsistent (connected);
  return trimming;
}

double
longestEdgeOf (const Positions& positions, const std::vector<Triangle>& triangles)
{
  double longest = 0.0;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max (longest, (positions[t[i]] - positions[t[(i + 1) % 3]]).norm ());
  return longest;
}

TEST (Trimming, NothingByDefaultOrIfAllIsWithinTheLimits)
{
  EXPECT_FALSE (asksForTrimming ({}));
  EXPECT_TRUE (asksForTrimming (limits (1e-9)));
  EXPECT_TRUE (asksForTrimming (limits (0.0, 3.0)));
  EXPECT_TRUE (asksForTrimming (limits (0.0, 0.0, 1)));
  Mesh mesh = sheet (5);
  const double longest = longestEdgeOf (mesh.positions, mesh.triangles); // of every triangle
  for (const TrimmingOptions& options :
       {TrimmingOptions (), limits (10.0 * longest), limits (0.0, 1.42), limits (0.0, 0.0, 36)})
    EXPECT_EQ (trim (mesh, options).triangles, 0U);
  EXPECT_EQ (trim (mesh, limits (9.99 * longest)).triangles, 50U);
}

TEST (Trimming, AGapBecomesABoundary)
{
  for (const TrimmingOptions& options : {limits (3.0), limits (0.0, 3.0)}) {
    Mesh mesh = sheet (10);
    for (Eigen::Vector3d& p : mesh.positions)
      p.x () += p.x () > 0.55 ? 0.5 : 0.0;
    const Trimming trimming = trim (mesh, options);
    EXPECT_EQ (trimming.triangles, 20U);
    EXPECT_TRUE (trimming.points.empty ());
    EXPECT_EQ (trimming.components, 0U);
    expectTopology (mesh.triangles, 121, 2, 2, 2);
  }
}

TEST (Trimming, TrianglesThatCrossAreOpened)
{
  const TrimmingOptions options{0.0, 0.0, true, 0};
  EXPECT_TRUE (asksForTrimming (options));
  Mesh flat = sheet (10), mesh = crossedSheets ();
  EXPECT_EQ (trim (flat, options).triangles, 0U);
  const std::size_t pairs = crossingOf (mesh).size ();
  const Trimming trimming = trim (mesh, options);
  EXPECT_EQ (trimming.crossing, trimming.triangles);
  EXPECT_GT (trimming.triangles, 0U);
  EXPECT_LT (trimming.triangles, 2 * pairs);
  EXPECT_TRUE (crossingOf (mesh).empty ());
}

TEST (Trimming, WhateverIsCutTheMeshStaysAManifold)
{
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U})
    for (const std::size_t one_in : {2U, 3U, 5U, 10U, 30U})
      for (const Mesh& whole : {sheet (20), torus (30, 20), annulus (40)}) {
        Mesh mesh = whole;
        RandomStream random (100 * seed + one_in);
        for (std::size_t p = 0; p < mesh.positions.size (); ++p)
          if (random.below (one_in) == 0)
            mesh.positions[p].z () += 20.0 + static_cast<double> (5 * p);
        trim (mesh, limits (10.0));
        EXPECT_LE (longestEdgeOf (mesh.positions, mesh.triangles), 1.0);
        EXPECT_GT (mesh.triangles.size (), one_in < 30 ? 0 : whole.triangles.size () / 2);
      }
}

TEST (Trimming, SmallComponents)
{
  Mesh mesh = beside (sheet (4), tetrahedron ());
  EXPECT_EQ (trim (mesh, limits (0.0, 0.0, 4)).triangles, 0U);
  Trimming trimming = trim (mesh, limits (0.0, 0.0, 5));
  EXPECT_EQ (trimming.triangles, 4U);
  EXPECT_EQ (trimming.components, 1U);
  EXPECT_EQ (trimming.points, (std::vector<Index>{25, 26, 27, 28}));
  trimming = trim (mesh, limits (0.0, 0.0, 26));
  EXPECT_EQ (trimming.components, 1U);
  EXPECT_TRUE (mesh.triangles.empty ());
}

} // namespace
} // namespace pcl::floater
