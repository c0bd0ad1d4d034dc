// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh: flips and splits; vertices that are split; normals of vertices.
#include "mesh/triangle_mesh.h"

#include "mesh/known_meshes.h"
#include "mesh/vertex_splits.h"

#include <pcl/surface/floater/vertex_normals.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace pcl::floater {
namespace {
using namespace samples;

TEST (TriangleMesh, RandomFlipsAndSplitsKeepADisc)
{
  RandomStream random (1);
  TriangleMesh mesh = connected (sheet (5).triangles, 136);
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

// Adds points, and expects the same topology with all of them. That there are few folds then is tested with the whole
// method, on stacked points.
TriangleMesh
expectSplits (Mesh mesh, const Positions& points)
{
  const MeshTopology before = topologyOf (mesh.triangles);
  TriangleMesh result = connected (mesh);
  std::vector<Index> added;
  for (const Eigen::Vector3d& p : points) {
    added.push_back (static_cast<Index> (mesh.positions.size ()));
    mesh.positions.push_back (p);
  }
  EXPECT_EQ (splitVertices (result, mesh.positions, added, {}, 1), points.size ());
  expectConsistent (result);
  expectTopology (result.triangles, before.vertices + points.size (), before.components,
                  before.euler, before.loops.size ());
  return result;
}

TEST (VertexSplits, TopologyStaysWhereverPointsAre)
{
  RandomStream random (2);
  const Mesh lone{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
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
  for (const double scale : {0x1p-1000, 0x1p-600, 0x1p600, 0x1p1000})
    EXPECT_EQ (vertexNormals (placed (torus.positions, {0, 0, 0}, scale), torus.triangles, 1),
               normals)
        << scale;
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
