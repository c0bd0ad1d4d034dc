// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Folds beside the boundary.
#include "mesh/open_boundary.h"

#include "mesh/connected_mesh.h"
#include "mesh/fold_repair.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::connected;
using samples::Mesh;

std::size_t
foldsOf (const TriangleMesh& changed, const Mesh& mesh)
{
  return findFolds (changed, mesh.positions, 1).size ();
}

// Opens folds, and expects all of them to end, that no point is lost, and one boundary loop.
// Returns how many triangles were taken out.
std::size_t
openAll (TriangleMesh& changed, const Mesh& mesh)
{
  const std::size_t taken = openBoundaryFolds (changed, mesh.positions, 1);
  EXPECT_EQ (foldsOf (changed, mesh), 0U);
  EXPECT_EQ (boundaryLoops (changed, 1).size (), 1U);
  for (const Index t : changed.triangle_of)
    EXPECT_NE (t, NONE);
  return taken;
}

// Squares of a strip of two rows, cut along diagonals. Point x of row y is 7 y + x.
Mesh
strip ()
{
  constexpr Index COLUMNS = 6;
  Mesh mesh;
  for (Index y = 0; y < 3; ++y)
    for (Index x = 0; x <= COLUMNS; ++x)
      mesh.positions.emplace_back (x, y, 0.0);
  for (Index y = 0; y < 2; ++y)
    for (Index x = 0; x < COLUMNS; ++x) {
      const Index a = y * (COLUMNS + 1) + x, b = a + 1, c = a + COLUMNS + 1, d = c + 1;
      mesh.triangles.push_back ({a, b, d});
      mesh.triangles.push_back ({a, d, c});
    }
  return mesh;
}

TEST (BoundaryFolds, FlatAndClosedMeshesStay)
{
  for (const Mesh& mesh :
       {samples::sheet (9), samples::annulus (12), samples::torus (9, 7), Mesh ()}) {
    TriangleMesh changed = connected (mesh);
    EXPECT_EQ (openBoundaryFolds (changed, mesh.positions, 1), 0U);
    EXPECT_EQ (changed.triangles, mesh.triangles);
  }
}

TEST (BoundaryFolds, TrianglesBesideTheBoundaryAreTakenOut)
{
  // An inner point is moved across the boundary: two triangles are turned over.
  Mesh mesh = strip ();
  mesh.positions[10] = {3.0, -0.5, 0.0};
  TriangleMesh changed = connected (mesh);
  ASSERT_GT (foldsOf (changed, mesh), 0U);
  EXPECT_EQ (openAll (changed, mesh), 2U);
}

TEST (BoundaryFolds, TwoTrianglesAreTakenOutIfOneIsNotEnough)
{
  // A fan at the boundary point 0, whose second triangle is folded against the third one. Points 2
  // to 4 are inside.
  Mesh mesh;
  mesh.positions = {{0, 0, 0},         {-1.3, -0.4, 2.1}, {-1.2, 0.2, 0.3}, {0.1, 0.7, 0.1},
                    {-2.2, -0.1, 0.3}, {-1, -0.5, 1.1},   {-3.5, 0.4, 0.8}, {-1.1, 0.6, 0.2}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {2, 1, 7},
                    {3, 2, 7}, {4, 3, 6}, {5, 4, 6}, {3, 7, 6}};
  TriangleMesh changed = connected (mesh);
  ASSERT_EQ (foldsOf (changed, mesh), 1U);
  EXPECT_EQ (openAll (changed, mesh), 2U);
}

TEST (BoundaryFolds, NothingIsTakenWhereAPartOfAMeshEnds)
{
  // The strip with the two triangles that are turned over. The mesh goes on beyond its ends, but
  // for the first column in the second case: that is too far from the fold to end it.
  Mesh mesh = strip ();
  mesh.positions[10] = {3.0, -0.5, 0.0};
  for (const Index first : {0U, 1U}) {
    TriangleMesh part = connected (mesh);
    part.is_partial.assign (mesh.positions.size (), 0);
    for (const std::vector<Index>& loop : boundaryLoops (part, 1))
      for (const Index p : loop)
        part.is_partial[p] = p % 7 >= first ? 1 : 0;
    ASSERT_GT (foldsOf (part, mesh), 0U);
    EXPECT_EQ (openBoundaryFolds (part, mesh.positions, 1), 0U);
    EXPECT_EQ (part.triangles, mesh.triangles);
  }
}

TEST (BoundaryFolds, EveryPointKeepsATriangle)
{
  // A fold whose triangles are all that their points have.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0.9, 0.01}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  TriangleMesh changed = connected (mesh);
  ASSERT_EQ (foldsOf (changed, mesh), 1U);
  EXPECT_EQ (openBoundaryFolds (changed, mesh.positions, 1), 0U);
  EXPECT_EQ (changed.triangles, mesh.triangles);
}

} // namespace
} // namespace pcl::floater
