// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_mesh.h"

#include "samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

namespace pcl::floater {
namespace {
// Connected mesh of these triangles.
TriangleMesh
meshOf (std::vector<Triangle> triangles, std::size_t points)
{
  TriangleMesh mesh;
  mesh.triangles = std::move (triangles);
  EXPECT_TRUE (mesh.connect (points, 1));
  return mesh;
}

// Cells of a square grid, each cut in two.
std::vector<Triangle>
gridTriangles (Index side)
{
  std::vector<Triangle> triangles;
  for (Index y = 0; y + 1 < side; ++y)
    for (Index x = 0; x + 1 < side; ++x) {
      const Index a = y * side + x, b = a + 1, c = a + side, d = c + 1;
      triangles.push_back ({a, b, d});
      triangles.push_back ({a, d, c});
    }
  return triangles;
}

const std::vector<Triangle> TETRAHEDRON = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

// Expects the neighbours that connect () finds, and one of its triangles for every vertex.
void
expectConsistent (const TriangleMesh& mesh)
{
  TriangleMesh fresh;
  fresh.triangles = mesh.triangles;
  ASSERT_TRUE (fresh.connect (mesh.triangle_of.size (), 1));
  EXPECT_EQ (mesh.neighbors, fresh.neighbors);
  for (Index p = 0; p < mesh.triangle_of.size (); ++p) {
    ASSERT_EQ (mesh.triangle_of[p] == NONE, fresh.triangle_of[p] == NONE);
    if (mesh.triangle_of[p] != NONE) {
      const Triangle& t = mesh.triangles[mesh.triangle_of[p]];
      EXPECT_NE (std::find (t.begin (), t.end (), p), t.end ());
    }
  }
  EXPECT_TRUE (samples::topologyOf (mesh.triangles).manifold);
}

TEST (TriangleMesh, FansGoRoundTheirPoint)
{
  const TriangleMesh mesh = meshOf (gridTriangles (6), 37); // point 36 is no vertex
  std::vector<Index> fan{5, 5};
  mesh.fan (36, fan);
  EXPECT_TRUE (fan.empty ());
  for (Index p = 0; p < 36; ++p) {
    mesh.fan (p, fan);
    const auto count =
        std::count_if (mesh.triangles.begin (), mesh.triangles.end (), [p] (const Triangle& t) {
          return std::find (t.begin (), t.end (), p) != t.end ();
        });
    ASSERT_EQ (fan.size (), static_cast<std::size_t> (count));
    const bool border = p % 6 == 0 || p % 6 == 5 || p / 6 == 0 || p / 6 == 5;
    for (std::size_t i = 0; i < fan.size (); ++i) {
      // Anti-clockwise: the edge that leaves one triangle enters the next.
      const Triangle& now = mesh.triangles[fan[i]];
      const Triangle& then = mesh.triangles[fan[(i + 1) % fan.size ()]];
      const bool joined = now[TriangleMesh::previous (mesh.sideOf (fan[i], p))] ==
                          then[TriangleMesh::next (mesh.sideOf (fan[(i + 1) % fan.size ()], p))];
      EXPECT_EQ (joined, !(border && i + 1 == fan.size ()));
    }
  }
}

TEST (TriangleMesh, HasEdge)
{
  const TriangleMesh mesh = meshOf (gridTriangles (5), 25);
  std::set<std::pair<Index, Index>> edges;
  for (const Triangle& t : mesh.triangles)
    for (const auto& [a, b] : {std::pair{t[0], t[1]}, std::pair{t[1], t[2]}, std::pair{t[2], t[0]}})
      edges.insert (std::minmax (a, b));
  for (Index p = 0; p < 25; ++p)
    for (Index q = 0; q < 25; ++q) {
      if (p != q) {
        EXPECT_EQ (mesh.hasEdge (p, q), edges.count (std::minmax (p, q)) == 1) << p << ' ' << q;
      }
    }
}

TEST (TriangleMesh, FlipExchangesTheDiagonals)
{
  TriangleMesh mesh = meshOf ({{0, 1, 2}, {3, 2, 1}}, 4);
  mesh.flip ({0, 0});
  EXPECT_EQ (mesh.triangles[0], (Triangle{0, 1, 3})); // corner, from, opposite
  EXPECT_EQ (mesh.triangles[1], (Triangle{3, 2, 0})); // opposite, to, corner
  expectConsistent (mesh);
  EXPECT_TRUE (mesh.hasEdge (0, 3));
  EXPECT_FALSE (mesh.hasEdge (1, 2));
}

TEST (TriangleMesh, RandomFlipsAndSplitsKeepADisc)
{
  RandomStream random (1);
  TriangleMesh mesh = meshOf (gridTriangles (6), 136);
  std::size_t flips = 0;
  for (Index p = 36; p < 136; ++p) {
    mesh.split (static_cast<Index> (random.below (mesh.triangles.size ())), p);
    for (int i = 0; i < 10; ++i) {
      const MeshEdge e{static_cast<Index> (random.below (mesh.triangles.size ())),
                       static_cast<std::uint8_t> (random.below (3))};
      const MeshEdge m = mesh.mate (e);
      if (m.triangle != NONE && !mesh.hasEdge (mesh.corner (e), mesh.corner (m))) {
        mesh.flip (e);
        ++flips;
      }
    }
    if (p % 10 == 0)
      expectConsistent (mesh);
  }
  expectConsistent (mesh);
  EXPECT_GT (flips, 300U);
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_EQ (topology.euler, 1);
  EXPECT_EQ (topology.vertices, 136U);
  ASSERT_EQ (topology.loops.size (), 1U);
  EXPECT_EQ (topology.loops.front ().size (), 20U);
}

TEST (TriangleMesh, SplitAtTheBoundary)
{
  TriangleMesh mesh = meshOf ({{2, 0, 1}}, 4);
  mesh.split (0, 3);
  EXPECT_EQ (samples::unordered (mesh.triangles),
             (std::set<Triangle>{{0, 1, 3}, {1, 2, 3}, {0, 2, 3}}));
  expectConsistent (mesh);
}

TEST (TriangleMesh, ConnectTakesManifolds)
{
  TriangleMesh mesh = meshOf (TETRAHEDRON, 4);
  for (const auto& neighbors : mesh.neighbors)
    EXPECT_EQ (std::count (neighbors.begin (), neighbors.end (), NONE), 0);
  EXPECT_TRUE (boundaryLoops (mesh, 1).empty ());
  mesh = meshOf ({}, 3);
  EXPECT_EQ (mesh.triangle_of, (std::vector<Index>{NONE, NONE, NONE}));
}

// Triangles of a large grid with points and triangles in random order.
std::vector<Triangle>
mixedGrid (Index side)
{
  std::vector<Triangle> triangles = gridTriangles (side);
  std::vector<Index> place (side * side);
  std::iota (place.begin (), place.end (), Index{0});
  std::shuffle (place.begin (), place.end (), std::mt19937 (1));
  for (Triangle& t : triangles)
    for (Index& p : t)
      p = place[p];
  std::shuffle (triangles.begin (), triangles.end (), std::mt19937 (2));
  return triangles;
}

TEST (TriangleMesh, ConnectFindsTheSameOnAllThreads)
{
  constexpr Index SIDE = 150; // points in two ranges
  for (const std::vector<Triangle>& triangles : {gridTriangles (SIDE), mixedGrid (SIDE)}) {
    std::map<std::pair<Index, Index>, Index> triangle_at; // left of each directed edge
    for (Index t = 0; t < triangles.size (); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        triangle_at[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
    for (const int threads : {1, 2, 5}) {
      TriangleMesh mesh;
      mesh.triangles = triangles;
      ASSERT_TRUE (mesh.connect (SIDE * SIDE + 3, threads));
      for (Index t = 0; t < triangles.size (); ++t)
        for (std::uint8_t side = 0; side < 3; ++side) {
          const auto across = triangle_at.find ({mesh.to ({t, side}), mesh.from ({t, side})});
          EXPECT_EQ (mesh.neighbors[t][side], across == triangle_at.end () ? NONE : across->second);
          EXPECT_GE (mesh.triangle_of[triangles[t][side]], t); // the last one
        }
      EXPECT_EQ (mesh.triangle_of[SIDE * SIDE + 2], NONE);
    }
  }
}

TEST (TriangleMesh, ComponentsAreNumberedByTheirFirstTriangles)
{
  constexpr Index SIDE = 300; // triangles in three ranges
  for (const bool is_mixed : {false, true}) {
    TriangleMesh mesh;
    for (const Triangle& t : is_mixed ? mixedGrid (SIDE) : gridTriangles (SIDE))
      if (is_mixed || t[0] / SIDE % 7 != 3) // strips
        mesh.triangles.push_back (t);
    ASSERT_TRUE (mesh.connect (SIDE * SIDE, 1));
    if (is_mixed) // so many neighbours are cut off that there are many components
      for (Index t = 0; t < mesh.triangles.size (); ++t)
        for (std::uint8_t side = 0; side < 3; ++side)
          if (mesh.neighbors[t][side] != NONE && (t + mesh.neighbors[t][side]) % 3 == 0)
            mesh.neighbors[t][side] = NONE;
    std::vector<Index> expected (mesh.triangles.size (), NONE);
    Index count = 0;
    for (Index start = 0; start < expected.size (); ++start) {
      if (expected[start] != NONE)
        continue;
      std::vector<Index> front (1, start);
      while (!front.empty ()) {
        const Index t = front.back ();
        front.pop_back ();
        expected[t] = count;
        for (const Index u : mesh.neighbors[t])
          if (u != NONE && expected[u] == NONE)
            front.push_back (u);
      }
      ++count;
    }
    EXPECT_GT (count, 40U);
    for (const int threads : {1, 2, 5}) {
      const MeshComponents components = findComponents (mesh, threads);
      EXPECT_EQ (components.count, count);
      EXPECT_EQ (components.of_triangle, expected);
    }
  }
  EXPECT_EQ (findComponents ({}, 2).count, 0U);
}

TEST (TriangleMesh, ConnectRefusesWhatIsNoOrientedManifold)
{
  const std::vector<std::pair<const char*, std::vector<Triangle>>> broken = {
      {"three triangles at an edge", {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}},
      {"wound against each other", {{0, 1, 2}, {0, 1, 3}}},
      {"the same triangle twice", {{0, 1, 2}, {1, 2, 0}}},
      {"a corner twice", {{0, 1, 1}}},
      {"a corner thrice", {{2, 2, 2}}},
      {"two fans, open", {{0, 1, 2}, {0, 3, 4}}},
      {"two fans, closed",
       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 5, 4}, {0, 4, 6}, {4, 5, 6}, {5, 0, 6}}}};
  for (const auto& [why, triangles] : broken) {
    TriangleMesh mesh;
    mesh.triangles = triangles;
    EXPECT_FALSE (mesh.connect (7, 1)) << why;
    EXPECT_FALSE (samples::topologyOf (triangles).manifold) << why;
  }
}

// Corners, neighbours and the triangle of every vertex are the same.
void
expectEqual (const TriangleMesh& a, const TriangleMesh& b)
{
  EXPECT_EQ (a.triangles, b.triangles);
  EXPECT_EQ (a.neighbors, b.neighbors);
  EXPECT_EQ (a.triangle_of, b.triangle_of);
}

TEST (TriangleMesh, UndoesFlipsAndSplits)
{
  TriangleMesh mesh = meshOf (gridTriangles (6), 37);
  mesh.split (0, 36); // not recorded
  EXPECT_EQ (mesh.mark (), 0U);
  const TriangleMesh before = mesh;
  mesh.recordChanges ();
  mesh.flip ({20, 1});
  EXPECT_GT (mesh.mark (), 0U);
  const std::size_t mark = mesh.mark ();
  const TriangleMesh between = mesh;
  mesh.flip ({20, 1});
  mesh.flip ({30, 1});
  std::vector<Index> changed;
  mesh.journal.appendTriangles (changed);
  for (const Index t : {20U, 30U})
    EXPECT_NE (std::find (changed.begin (), changed.end (), t), changed.end ());
  mesh.undo (mark);
  expectEqual (mesh, between);
  mesh.undo (0);
  expectEqual (mesh, before);
  mesh.recordChanges (false);
  mesh.flip ({20, 1});
  EXPECT_EQ (mesh.mark (), 0U);
}

TEST (TriangleMesh, ACopyHasAJournalOfItsOwn)
{
  TriangleMesh mesh = meshOf (gridTriangles (6), 36);
  const TriangleMesh before = mesh;
  mesh.recordChanges ();
  mesh.flip ({20, 1});
  const TriangleMesh flipped_once = mesh;
  const std::size_t mark = mesh.mark ();
  TriangleMesh copy = mesh;
  copy.flip ({30, 1});
  EXPECT_GT (copy.mark (), mark);
  EXPECT_EQ (mesh.mark (), mark);
  expectEqual (mesh, flipped_once);
  copy.undo (mark);
  expectEqual (copy, flipped_once);
  // Undone in the copy, not in the original; then the other way round.
  copy.undo (0);
  expectEqual (copy, before);
  expectEqual (mesh, flipped_once);
  mesh.undo (0);
  expectEqual (mesh, before);
  expectConsistent (mesh);
}

TEST (TriangleMesh, BoundaryLoopsHaveTheSurfaceOnTheirLeft)
{
  std::vector<Triangle> annulus = gridTriangles (5); // without its middle: points 5 x 5
  annulus.erase (std::remove_if (annulus.begin (), annulus.end (),
                                 [] (const Triangle& t) {
                                   return std::find (t.begin (), t.end (), 12U) != t.end ();
                                 }),
                 annulus.end ());
  const TriangleMesh mesh = meshOf (annulus, 25);
  const std::vector<std::vector<Index>> expected = {
      {0, 1, 2, 3, 4, 9, 14, 19, 24, 23, 22, 21, 20, 15, 10, 5}, {6, 11, 17, 18, 13, 7}};
  EXPECT_EQ (boundaryLoops (mesh, 1), expected);
}

} // namespace
} // namespace pcl::floater
