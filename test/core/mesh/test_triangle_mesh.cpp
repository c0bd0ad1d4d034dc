// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh: neighbours, components, flips and splits; vertices that are split; normals of vertices.
#include "mesh/triangle_mesh.h"

#include "mesh/folds.h"
#include "mesh/known_meshes.h"
#include "mesh/vertex_splits.h"

#include <pcl/surface/floater/vertex_normals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

namespace pcl::floater {
namespace {
using namespace samples;

// Cells of a square grid, each cut in two.
std::vector<Triangle>
gridTriangles (Index side)
{
  return sheet (side - 1).triangles;
}

TEST (TriangleMesh, RandomFlipsAndSplitsKeepADisc)
{
  RandomStream random (1);
  TriangleMesh mesh = connected (gridTriangles (6), 136);
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
  EXPECT_GT (flips, 300U);
  EXPECT_EQ (expectDisc (mesh, 136).size (), 20U);
}

// Triangles of a large grid with points and triangles in random order.
std::vector<Triangle>
mixedGrid (Index side)
{
  std::vector<Triangle> triangles = gridTriangles (side);
  const std::vector<Index> place = permutation (side * side, 1);
  for (Triangle& t : triangles)
    for (Index& p : t)
      p = place[p];
  std::shuffle (triangles.begin (), triangles.end (), std::mt19937 (2));
  return triangles;
}

TEST (TriangleMesh, ConnectFindsTheTriangleAcrossEveryEdge)
{
  constexpr Index SIDE = 150; // points in two ranges
  for (const std::vector<Triangle>& triangles : {gridTriangles (SIDE), mixedGrid (SIDE)}) {
    std::map<std::pair<Index, Index>, Index> triangle_at; // left of each directed edge
    for (Index t = 0; t < triangles.size (); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        triangle_at[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
    TriangleMesh mesh;
    mesh.triangles = triangles;
    ASSERT_TRUE (mesh.connect (SIDE * SIDE + 3, 2));
    for (Index t = 0; t < triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const auto across = triangle_at.find ({mesh.to ({t, side}), mesh.from ({t, side})});
        EXPECT_EQ (mesh.neighbors[t][side], across == triangle_at.end () ? NONE : across->second);
        EXPECT_GE (mesh.triangle_of[triangles[t][side]], t); // the last one
      }
    EXPECT_EQ (mesh.triangle_of[SIDE * SIDE + 2], NONE);
  }
}

TEST (TriangleMesh, ComponentsAreNumberedByTheirFirstTriangles)
{
  constexpr Index SIDE = 300; // triangles in three ranges
  for (const bool is_mixed : {false, true}) {
    TriangleMesh mesh = connected (is_mixed ? mixedGrid (SIDE) : gridTriangles (SIDE), SIDE * SIDE);
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (Index& neighbor : mesh.neighbors[t])
        if (neighbor != NONE && (t + neighbor) % 3 == 0) // so that there are many components
          neighbor = NONE;
    std::vector<Index> expected (mesh.triangles.size (), NONE);
    Index count = 0;
    for (Index start = 0; start < expected.size (); ++start)
      if (expected[start] == NONE) {
        std::vector<Index> front (1, start);
        while (!front.empty ()) {
          const Index t = front.back ();
          front.pop_back ();
          if (t == NONE || expected[t] != NONE)
            continue;
          expected[t] = count;
          front.insert (front.end (), mesh.neighbors[t].begin (), mesh.neighbors[t].end ());
        }
        ++count;
      }
    EXPECT_GT (count, 40U);
    const MeshComponents components = findComponents (mesh, 2);
    EXPECT_EQ (components.count, count);
    EXPECT_TRUE (components.of_triangle == expected);
  }
  EXPECT_EQ (findComponents ({}, 2).count, 0U);
}

// Adds points, and expects the same topology with all of them.
TriangleMesh
expectSplits (Mesh mesh, const Positions& points, const SplitLimits& limits = {})
{
  const MeshTopology before = topologyOf (mesh.triangles);
  TriangleMesh result = connected (mesh);
  std::vector<Index> added;
  for (const Eigen::Vector3d& p : points) {
    added.push_back (static_cast<Index> (mesh.positions.size ()));
    mesh.positions.push_back (p);
  }
  EXPECT_EQ (splitVertices (result, mesh.positions, added, limits, 1), points.size ());
  expectConsistent (result);
  const MeshTopology after = topologyOf (result.triangles);
  EXPECT_EQ (after.vertices, before.vertices + points.size ());
  EXPECT_EQ (after.euler, before.euler);
  EXPECT_EQ (after.components, before.components);
  EXPECT_EQ (after.loops.size (), before.loops.size ());
  return result;
}

std::size_t
foldsOf (const TriangleMesh& mesh, const Positions& positions)
{
  return findFolds (mesh, positions, 1).size ();
}

TEST (VertexSplits, TopologyStaysWhereverPointsAre)
{
  RandomStream random (2);
  Mesh lone;
  lone.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  lone.triangles = {{0, 1, 2}};
  for (const Mesh& mesh :
       {lone, tetrahedron (), sheet (4), annulus (9), torus (9, 5), beside (sheet (3), lone)})
    for (const double offset : {1e-12, 0.01, 0.1, 1.0}) {
      SCOPED_TRACE (offset);
      Positions points;
      for (int i = 0; i < 150; ++i)
        points.emplace_back (mesh.positions[random.below (mesh.positions.size ())] +
                             offset * normalVector (random));
      expectSplits (mesh, points);
    }
}

// A flat sheet has no bending, and a point in it adds none.
TEST (VertexSplits, FlatStaysFlat)
{
  const Mesh sheet = samples::sheet (6);
  Positions positions = sheet.positions, inside;
  for (int i = 0; i < 28; ++i)
    inside.emplace_back (0.05 + 0.019 * i, 0.03 + 0.37 * (i % 2) + 0.007 * i, 0.0);
  const TriangleMesh mesh = expectSplits (sheet, inside);
  positions.insert (positions.end (), inside.begin (), inside.end ());
  EXPECT_NEAR (areaOf (mesh.triangles, positions), 0.36, 1e-12);
  EXPECT_EQ (foldsOf (mesh, positions), 0U);
  // Beside the boundary, a point joins it: one more edge.
  const TriangleMesh wider = expectSplits (sheet, {{0.33, -0.04, 0.0}});
  EXPECT_EQ (topologyOf (wider.triangles).loops.front ().size (), 25U);
}

// Above each vertex of a bent sheet a stack of three points: no cut of a fan needs a fold.
TEST (VertexSplits, StacksAreConnectedWithoutFolds)
{
  const Mesh sheet = cells (20, 20, [] (Index x, Index y) {
    return Eigen::Vector3d (0.1 * x, 0.1 * y, 0.1 * std::sin (0.5 * x));
  });
  RandomStream random (5);
  Positions positions = sheet.positions, stacked;
  for (const Eigen::Vector3d& p : sheet.positions)
    for (int i = 0; i < 3; ++i)
      stacked.emplace_back (p + 0.003 * normalVector (random));
  const TriangleMesh mesh = expectSplits (sheet, stacked);
  positions.insert (positions.end (), stacked.begin (), stacked.end ());
  SplitLimits bending_only;
  bending_only.fold = 0.0;
  const std::size_t folds = foldsOf (mesh, positions);
  EXPECT_LE (folds, 5U);
  EXPECT_GT (foldsOf (expectSplits (sheet, stacked, bending_only), positions), 100U);
  SplitLimits once;
  once.passes = 0;
  EXPECT_GE (foldsOf (expectSplits (sheet, stacked, once), positions), folds);
}

// A point within the rim, and a little above or below it, stays inside.
TEST (VertexSplits, TheBoundaryPassesEachStackOnce)
{
  const Mesh sheet = samples::sheet (20);
  RandomStream random (6);
  Positions stacked;
  const std::vector<Index> rim = topologyOf (sheet.triangles).loops.front ();
  for (const Index p : rim) {
    const Eigen::Vector3d& at = sheet.positions[p];
    stacked.emplace_back (at + 0.003 * (sheet.positions[sheet.positions.size () / 2] - at) +
                          Eigen::Vector3d (0, 0, 0.003 * random.normal ()));
  }
  const TriangleMesh mesh = expectSplits (sheet, stacked);
  EXPECT_LE (topologyOf (mesh.triangles).loops.front ().size (), rim.size () + 4);
}

// Right normals are tested with the tool, against a formula.
TEST (VertexNormals, AreTheSameAtAnyScale)
{
  const Mesh torus = samples::torus (20, 9);
  const std::vector<Eigen::Vector3f> normals = vertexNormals (torus.positions, torus.triangles, 1);
  for (const double scale : {0x1p-1000, 0x1p-600, 0x1p600, 0x1p1000}) {
    Positions scaled = torus.positions;
    for (Eigen::Vector3d& p : scaled)
      p *= scale;
    EXPECT_EQ (vertexNormals (scaled, torus.triangles, 1), normals) << scale;
  }
}

TEST (VertexNormals, PointsThatNoTriangleTellsOfHaveNone)
{
  const double nan = std::nan ("");
  const Positions positions{{0, 0, 0}, {1, 0, 0},     {0, 1, 0}, {5, 5, 5}, {1, 0, 0},
                            {2, 0, 0}, {nan, nan, 0}, {1, 1, 0}, {9, 0, 0}, {9, 9, 0}};
  const Triangles triangles{{0, 1, 2}, // one that counts
                            {1, 4, 2}, // two equal corners
                            {0, 1, 5}, // on one line
                            {1, 6, 2}, // not finite
                            {7, 8, 9}, // twice, from both sides
                            {7, 9, 8}, {3, 3, 3}};
  const std::vector<Eigen::Vector3f> normals = vertexNormals (positions, triangles, 1);
  for (const std::size_t p : {0, 1, 2})
    EXPECT_EQ (normals[p], Eigen::Vector3f (0, 0, 1)) << p;
  for (const std::size_t p : {3, 4, 5, 6, 7, 8, 9})
    EXPECT_EQ (normals[p], Eigen::Vector3f (0, 0, 0)) << p;
  EXPECT_TRUE (vertexNormals ({}, {}).empty ());
  EXPECT_THROW (vertexNormals (positions, {{0, 1, 10}}), std::out_of_range);
}

} // namespace
} // namespace pcl::floater
