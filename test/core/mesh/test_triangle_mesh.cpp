// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_mesh.h"

#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace pcl::floater {
namespace {
using samples::connected;
using samples::expectConsistent;

// Cells of a square grid, each cut in two.
std::vector<Triangle>
gridTriangles (Index side)
{
  return samples::sheet (side - 1).triangles;
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
  EXPECT_EQ (samples::expectDisc (mesh, 136).size (), 20U);
}

// Triangles of a large grid with points and triangles in random order.
std::vector<Triangle>
mixedGrid (Index side)
{
  std::vector<Triangle> triangles = gridTriangles (side);
  const std::vector<Index> place = samples::permutation (side * side, 1);
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

} // namespace
} // namespace pcl::floater
