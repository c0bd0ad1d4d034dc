// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_splits.h"

#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::connected;
using samples::expectConsistent;
using samples::Mesh;

// Adds points, and expects the same topology with all of them.
TriangleMesh
expectSplits (Mesh mesh, const std::vector<Eigen::Vector3d>& points, const SplitLimits& limits = {})
{
  const samples::Topology before = samples::topologyOf (mesh.triangles);
  TriangleMesh result = connected (mesh);
  std::vector<Index> added;
  for (const Eigen::Vector3d& p : points) {
    added.push_back (static_cast<Index> (mesh.positions.size ()));
    mesh.positions.push_back (p);
  }
  EXPECT_EQ (splitVertices (result, mesh.positions, added, limits, 1), points.size ());
  expectConsistent (result);
  const samples::Topology after = samples::topologyOf (result.triangles);
  EXPECT_EQ (after.vertices, before.vertices + points.size ());
  EXPECT_EQ (after.euler, before.euler);
  EXPECT_EQ (after.components, before.components);
  EXPECT_EQ (after.loops.size (), before.loops.size ());
  return result;
}

std::size_t
foldsOf (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions)
{
  return samples::foldedEdges (mesh.triangles, positions).size ();
}

TEST (VertexSplits, TopologyStaysWhereverPointsAre)
{
  RandomStream random (2);
  Mesh lone;
  lone.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  lone.triangles = {{0, 1, 2}};
  for (const Mesh& mesh : {lone, samples::tetrahedron (), samples::sheet (4), samples::annulus (9),
                           samples::torus (9, 5), samples::beside (samples::sheet (3), lone)})
    for (const double offset : {1e-12, 0.01, 0.1, 1.0}) {
      SCOPED_TRACE (offset);
      std::vector<Eigen::Vector3d> points;
      for (int i = 0; i < 150; ++i) {
        const Eigen::Vector3d way (random.normal (), random.normal (), random.normal ());
        points.emplace_back (mesh.positions[random.below (mesh.positions.size ())] + offset * way);
      }
      expectSplits (mesh, points);
    }
}

// A flat sheet has no bending, and a point in it adds none.
TEST (VertexSplits, FlatStaysFlat)
{
  const Mesh sheet = samples::sheet (6);
  std::vector<Eigen::Vector3d> positions = sheet.positions, inside;
  for (int i = 0; i < 28; ++i)
    inside.emplace_back (0.05 + 0.019 * i, 0.03 + 0.37 * (i % 2) + 0.007 * i, 0.0);
  const TriangleMesh mesh = expectSplits (sheet, inside);
  positions.insert (positions.end (), inside.begin (), inside.end ());
  EXPECT_NEAR (samples::areaOf (mesh.triangles, positions), 0.36, 1e-12);
  EXPECT_EQ (foldsOf (mesh, positions), 0U);
  // Beside the boundary, a point joins it: one more edge.
  const TriangleMesh wider = expectSplits (sheet, {{0.33, -0.04, 0.0}});
  EXPECT_EQ (samples::topologyOf (wider.triangles).loops.front ().size (), 25U);
}

// Above each vertex of a bent sheet a stack of three points: no cut of a fan needs a fold.
TEST (VertexSplits, StacksAreConnectedWithoutFolds)
{
  const Mesh sheet = samples::cells (20, 20, [] (Index x, Index y) {
    return Eigen::Vector3d (0.1 * x, 0.1 * y, 0.1 * std::sin (0.5 * x));
  });
  RandomStream random (5);
  std::vector<Eigen::Vector3d> positions = sheet.positions, stacked;
  for (const Eigen::Vector3d& p : sheet.positions)
    for (int i = 0; i < 3; ++i)
      stacked.emplace_back (
          p + 0.003 * Eigen::Vector3d (random.normal (), random.normal (), random.normal ()));
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
  std::vector<Eigen::Vector3d> stacked;
  const std::vector<Index> rim = samples::topologyOf (sheet.triangles).loops.front ();
  for (const Index p : rim) {
    const Eigen::Vector3d& at = sheet.positions[p];
    stacked.emplace_back (at + 0.003 * (sheet.positions[sheet.positions.size () / 2] - at) +
                          Eigen::Vector3d (0, 0, 0.003 * random.normal ()));
  }
  const TriangleMesh mesh = expectSplits (sheet, stacked);
  EXPECT_LE (samples::topologyOf (mesh.triangles).loops.front ().size (), rim.size () + 4);
}

} // namespace
} // namespace pcl::floater
