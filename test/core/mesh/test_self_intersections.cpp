// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that cross each other: all are found, and they are removed.
#include "mesh/self_intersections.h"

#include "mesh/known_meshes.h"
#include "mesh/self_intersection_removal.h"
#include "mesh/vertex_stars.h"
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
crossingOf (const Mesh& mesh, int threads = 1)
{
  return findSelfIntersections (mesh.triangles, mesh.positions, threads);
}

// Two triangles: a right one in z = 0, and another one with some of its corners.
bool
crosses (const Positions& positions, const Triangle& other)
{
  return doCross ({0, 1, 2}, other, positions);
}

TEST (SelfIntersections, TwoTrianglesThatShareACornerOrAnEdge)
{
  const Positions right{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto with = [&right] (const Positions& more) {
    Positions all = right;
    all.insert (all.end (), more.begin (), more.end ());
    return all;
  };
  // No common corner: through the middle, beside it, and touching by a corner.
  EXPECT_TRUE (crosses (with ({{0.2, 0.2, -1}, {0.2, 0.2, 1}, {2, 2, 0.5}}), {3, 4, 5}));
  EXPECT_FALSE (crosses (with ({{2, 2, -1}, {2, 2, 1}, {3, 3, 0.5}}), {3, 4, 5}));
  EXPECT_TRUE (crosses (with ({{0.25, 0.25, 0}, {0.2, 0.2, 1}, {0.4, 0.2, 1}}), {3, 4, 5}));
  EXPECT_FALSE (crosses (with ({{0.25, 0.25, 1e-300}, {0.2, 0.2, 1}, {0.4, 0.2, 1}}), {3, 4, 5}));
  // A common corner: the edge opposite to it goes through the triangle, or by.
  EXPECT_TRUE (crosses (with ({{0.2, 0.2, -1}, {0.2, 0.2, 1}}), {0, 3, 4}));
  EXPECT_FALSE (crosses (with ({{-0.2, 0.2, -1}, {-0.2, 0.2, 1}}), {0, 3, 4}));
  EXPECT_TRUE (crosses (with ({{0.5, 0.25, 0}, {0.25, 0.5, 0}}), {3, 4, 0}));
  // A common edge: on the same side in one plane, on the other side, out of the plane.
  EXPECT_TRUE (crosses (with ({{1, 1, 0}}), {0, 1, 3}));
  EXPECT_FALSE (crosses (with ({{0, -1, 0}}), {1, 0, 3}));
  EXPECT_FALSE (crosses (with ({{0, 1, 1e-300}}), {0, 1, 3}));
  // A triangle whose corners lie on one line crosses nothing.
  EXPECT_FALSE (crosses (with ({{0.2, 0.2, -1}, {0.2, 0.2, 0}, {0.2, 0.2, 1}}), {3, 4, 5}));
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
  Mesh mesh;
  const auto add = [&mesh] (const Eigen::Vector3d& p) {
    mesh.positions.push_back (p);
    return static_cast<Index> (mesh.positions.size () - 1);
  };
  for (std::size_t t = 0; t < triangles; ++t) {
    const Eigen::Vector3d at = anywhere ();
    const Index a = add (at + 0.2 * anywhere ()), b = add (at + 0.2 * anywhere ()),
                c = add (at + 0.2 * anywhere ());
    mesh.triangles.push_back ({a, b, c});
  }
  for (std::size_t f = 0; f < fans; ++f) {
    constexpr Index SPOKES = 7;
    const Eigen::Vector3d at = anywhere ();
    const Index centre = add (at);
    for (Index i = 0; i < SPOKES; ++i)
      add (at + 0.2 * (anywhere () - Eigen::Vector3d::Constant (0.5)));
    for (Index i = 0; i < SPOKES; ++i)
      mesh.triangles.push_back ({centre, centre + 1 + i, centre + 1 + (i + 1) % SPOKES});
  }
  return mesh;
}

TEST (SelfIntersections, AllPairsAreFoundForAnyNumberOfThreads)
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
    EXPECT_EQ (crossingOf (mesh, 3), all);
  }
}

// The triangles of a range, and those whose boxes overlap one of them, in order.
std::vector<CrossingPair>
crossingOfPart (const std::vector<Triangle>& sorted, std::size_t first, std::size_t last,
                const Positions& positions)
{
  const auto isAround = [&] (std::size_t t) {
    for (std::size_t own = first; own < last; ++own)
      if (boxOf (sorted[t], positions).intersects (boxOf (sorted[own], positions)))
        return true;
    return false;
  };
  std::vector<Triangle> part;
  std::vector<Index> places;
  std::size_t before = 0;
  for (std::size_t t = 0; t < sorted.size (); ++t)
    if (isAround (t)) {
      before += t < first ? 1 : 0;
      part.push_back (sorted[t]);
      places.push_back (static_cast<Index> (t));
    }
  std::vector<CrossingPair> pairs =
      findSelfIntersectionsOf (part, before, before + last - first, positions, 2);
  EXPECT_TRUE (std::is_sorted (pairs.begin (), pairs.end ()));
  for (CrossingPair& pair : pairs)
    pair = {places[pair.first], places[pair.second]};
  return pairs;
}

TEST (SelfIntersections, PartsHaveAllPairsTogether)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Mesh mesh = randomTriangles (150, 60, seed);
    const std::vector<CrossingPair> all = crossingOf (mesh);
    const std::vector<Index> order = orderByPoints (mesh.triangles, mesh.positions.size ());
    std::vector<Triangle> sorted;
    sorted.reserve (order.size ());
    for (const Index t : order)
      sorted.push_back (mesh.triangles[t]);
    for (const std::size_t length : {std::size_t{1}, std::size_t{37}, sorted.size ()}) {
      std::vector<CrossingPair> found;
      for (std::size_t first = 0; first < sorted.size (); first += length)
        for (const CrossingPair& pair : crossingOfPart (
                 sorted, first, std::min (first + length, sorted.size ()), mesh.positions))
          found.push_back (pair);
      EXPECT_EQ (pairsInOrder (found, order), all);
    }
    EXPECT_TRUE (findSelfIntersectionsOf (sorted, 7, 7, mesh.positions, 1).empty ());
  }
}

TEST (SelfIntersections, AFanThatGoesRoundTwiceCrossesItself)
{
  // Eight sectors of 90 degrees around a point: triangle i and i + 4 lie on each other.
  Mesh twice;
  twice.positions.emplace_back (0, 0, 0);
  for (int i = 0; i < 8; ++i)
    twice.positions.emplace_back ((1 + 0.1 * i) * std::cos (i * PI / 2),
                                  (1 + 0.1 * i) * std::sin (i * PI / 2), 0);
  for (Index i = 0; i < 8; ++i)
    twice.triangles.push_back ({0, 1 + i, 1 + (i + 1) % 8});
  const std::vector<CrossingPair> pairs = crossingOf (twice);
  EXPECT_GE (pairs.size (), 4U);
  for (Index i = 0; i < 4; ++i)
    EXPECT_TRUE (std::binary_search (pairs.begin (), pairs.end (), CrossingPair{i, i + 4}));
}

// Two sheets of 0.1 mean spacing, one above the other; points of the upper one are swapped with
// those below, so that triangles cross.
struct Swapped
{
  Mesh mesh;
  TriangleMesh connected;
  CsrLists neighbors; // all points
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> spacing;

  Swapped (Index side, const std::vector<Index>& swapped)
  {
    mesh = sheet (side);
    const auto below = static_cast<Index> (mesh.positions.size ());
    RandomStream random (side);
    for (Eigen::Vector3d& p : mesh.positions)
      p += 0.02 * Eigen::Vector3d (random.uniform (), random.uniform (), random.uniform ());
    const Mesh lower = mesh;
    for (const Eigen::Vector3d& p : lower.positions)
      mesh.positions.push_back (p + Eigen::Vector3d (0.03, 0.04, 0.06));
    for (const Triangle& t : lower.triangles)
      mesh.triangles.push_back ({t[0] + below, t[1] + below, t[2] + below});
    for (Triangle& t : mesh.triangles)
      for (Index& p : t)
        for (const Index s : swapped)
          p = p == s ? s + below : p == s + below ? s : p;
    connected.triangles = mesh.triangles;
    EXPECT_TRUE (connected.connect (mesh.positions.size (), 1));
    normals.assign (mesh.positions.size (), Eigen::Vector3f::UnitZ ());
    spacing.assign (mesh.positions.size (), 0.1F);
    neighbors.offsets.push_back (0);
    for (Index p = 0; p < mesh.positions.size (); ++p) {
      for (Index q = 0; q < mesh.positions.size (); ++q)
        if (p != q && (mesh.positions[q] - mesh.positions[p]).norm () < 0.25)
          neighbors.ids.push_back (q);
      neighbors.offsets.push_back (static_cast<Index> (neighbors.ids.size ()));
    }
  }

  Uncrossing remove (const UncrossingLimits& limits = {})
  {
    return removeSelfIntersections (connected, crossingOf (mesh), neighbors,
                                    TriangleCost (mesh.positions, normals, &spacing),
                                    mesh.positions, limits, 1);
  }
};

TEST (SelfIntersections, AreRemovedByMovesAndNothingElseChanges)
{
  Swapped sheets (8, {30, 50});
  EXPECT_GE (crossingOf (sheets.mesh).size (), 4U);
  const samples::Topology before = samples::topologyOf (sheets.mesh.triangles);
  const Uncrossing done = sheets.remove ();
  EXPECT_EQ (done.pairs_left, 0U);
  EXPECT_GE (done.moves + done.flips, 2U);
  const Mesh after{sheets.mesh.positions, sheets.connected.triangles};
  EXPECT_TRUE (crossingOf (after).empty ());
  EXPECT_TRUE (samples::foldedEdges (after.triangles, after.positions).empty ());
  const samples::Topology topology = samples::topologyOf (after.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.vertices, before.vertices);
  EXPECT_EQ (topology.components, before.components);
  EXPECT_EQ (topology.euler, before.euler);
  EXPECT_EQ (topology.loops, before.loops);
}

// Where flips and moves of single points no longer help, patches are taken out and put back.
TEST (SelfIntersections, AreRemovedByPatchesWhereMovesDoNotHelp)
{
  UncrossingLimits moves_only;
  moves_only.rebuilt_orders = 0;
  std::size_t left_by_moves = 0, left = 0, rebuilds = 0;
  RandomStream random (12);
  for (int round = 0; round < 6; ++round) {
    std::vector<Index> swapped;
    for (Index p = 0; p < 81; ++p)
      if (random.uniform () < 0.2)
        swapped.push_back (p);
    left_by_moves += Swapped (8, swapped).remove (moves_only).pairs_left;
    Swapped sheets (8, swapped);
    const Uncrossing done = sheets.remove ();
    left += done.pairs_left;
    rebuilds += done.rebuilds;
    const Mesh after{sheets.mesh.positions, sheets.connected.triangles};
    EXPECT_EQ (crossingOf (after).size (), done.pairs_left);
    const samples::Topology topology = samples::topologyOf (after.triangles);
    EXPECT_TRUE (topology.manifold);
    EXPECT_EQ (topology.vertices, 162U);
    EXPECT_EQ (topology.euler, 2);
  }
  EXPECT_GT (rebuilds, 0U);
  EXPECT_LT (left, left_by_moves);
}

// What has been done when the tests are used up stays, and is told.
TEST (SelfIntersections, FewTestsEndTheRemovalEarly)
{
  UncrossingLimits limits;
  limits.tests_per_triangle = 0;
  std::size_t left_before = crossingOf (Swapped (8, {10, 30, 50}).mesh).size ();
  for (const std::size_t tests : {0U, 300U, 1'000'000U}) {
    Swapped sheets (8, {10, 30, 50});
    limits.fewest_tests = tests;
    const Uncrossing done = sheets.remove (limits);
    const Mesh after{sheets.mesh.positions, sheets.connected.triangles};
    EXPECT_EQ (crossingOf (after).size (), done.pairs_left);
    EXPECT_EQ (done.moves + done.flips == 0, tests == 0);
    if (tests > 0) {
      EXPECT_LT (done.pairs_left, left_before);
    }
    left_before = done.pairs_left;
    EXPECT_TRUE (samples::topologyOf (after.triangles).manifold);
  }
  EXPECT_EQ (left_before, 0U);
}

TEST (SelfIntersections, AreInTheReportWithPlaces)
{
  Swapped sheets (8, {40});
  const Points points = samples::pointsAt (sheets.mesh.positions);
  MeshExamination found = samples::check (sheets.mesh);
  EXPECT_EQ (found.check.self_intersections, 0U); // not looked for
  checkCrossing (sheets.mesh.triangles, points, 1, found);
  const std::vector<CrossingPair> pairs = crossingOf (sheets.mesh);
  ASSERT_FALSE (pairs.empty ());
  EXPECT_EQ (found.check.self_intersections, pairs.size ());
  const std::vector<std::array<std::uint32_t, 2>>& at = found.check.self_intersections_at;
  ASSERT_EQ (at.size (), std::min<std::size_t> (pairs.size (), 10));
  for (std::size_t i = 0; i < at.size (); ++i) {
    EXPECT_EQ (at[i][0], points.cloud_index[sheets.mesh.triangles[pairs[i].first][0]]);
    EXPECT_EQ (at[i][1], points.cloud_index[sheets.mesh.triangles[pairs[i].second][0]]);
  }
  Report report;
  ASSERT_FALSE (reportCheck (points, found, {}, report));
  EXPECT_TRUE (std::any_of (
      report.warnings.begin (), report.warnings.end (),
      [&pairs] (const std::string& warning) {
        return warning.rfind (std::to_string (pairs.size ()) + " pairs of triangles cross", 0) == 0;
      }))
      << testing::PrintToString (report.warnings);
}

} // namespace
} // namespace pcl::floater
