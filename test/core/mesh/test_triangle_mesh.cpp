// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh: flips and splits; vertices that are split; normals of vertices. Which side of a surface becomes its front,
// and what that is decided by.
#include "mesh/triangle_mesh.h"

#include "mesh/facing.h"
#include "mesh/known_meshes.h"
#include "mesh/vertex_splits.h"

#include <pcl/surface/floater/vertex_normals.h>

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using facing_cases::makeBowl;
using namespace samples;

TEST (TriangleMesh, RandomFlipsAndSplitsKeepADisc)
{
  RandomStream random (1);
  TriangleMesh mesh = connected (sheet (5).triangles, 136);
  std::size_t flips = 0;
  for (Index p = 36; p < 136; ++p) {
    const auto t = static_cast<Index> (random.below (mesh.triangles.size ()));
    const auto added = static_cast<Index> (mesh.triangles.size ());
    mesh.triangles.resize (added + 2U);
    mesh.neighbors.resize (added + 2U);
    mesh.split (t, p, added, added + 1);
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
  splitVertices (result, mesh.positions, added, 1);
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

TEST (Facing, EveryFormFacesOneWayWhateverItDidBefore)
{
  const auto square = [] (const std::function<Eigen::Vector3d (double, double)>& shape) {
    return cells (40, 40, [&] (Index x, Index y) { return shape (x / 40.0, y / 40.0); });
  };
  const auto terrain = [&square] (const std::function<double (double, double)>& height) {
    return square ([&] (double u, double v) { return Eigen::Vector3d (u, v, height (u, v)); });
  };
  const auto tube = [] (Index rows) {
    return cells (
        40, rows, [] (Index x, Index y) { return polar (1.0, PI * x / 20.0, 0.075 * y); }, true);
  };
  // Meshes that face as they should.
  const std::vector<std::pair<const char*, Mesh>> forms{
      {"long tube", tube (100)},
      {"tube", tube (40)},
      {"short tube", tube (3)},
      {"half sphere", makeBowl (0.5)},
      {"nearly a sphere", makeBowl (0.975)},
      {"bowl", makeBowl (0.35)},
      {"flat", terrain ([] (double, double) { return 1.0; })},
      {"hills", terrain ([] (double u, double v) {
         return 0.1 * std::sin (9.0 * u) * std::cos (7.0 * v) + 0.3 * u;
       })},
      {"folds in a valley", terrain ([] (double u, double v) {
         return 0.2 * std::sin (12.0 * u) + 0.7 * std::pow (std::hypot (u - 0.5, v - 0.5), 2.0);
       })},
      {"steep folds", terrain ([] (double u, double v) {
         return 0.3 * std::sin (12.0 * u) + 0.02 * std::sin (9.0 * v);
       })},
      {"shallow valley", terrain ([] (double u, double v) {
         return 0.3 * (std::pow (u - 0.5, 2.0) + std::pow (v - 0.5, 2.0));
       })},
      {"pit with slopes of 45 degrees", terrain ([] (double u, double v) {
         return std::clamp (std::hypot (u - 0.5, v - 0.5), 0.2, 0.45);
       })},
      {"upright in y",
       square ([] (double u, double v) { return Eigen::Vector3d (-u, -0.1 * u, v); })},
      {"upright in x",
       square ([] (double u, double v) { return Eigen::Vector3d (0.1 * u, u, v); })},
      {"of equal slope", square ([] (double u, double v) { return Eigen::Vector3d (u, v, u); })}};
  for (const auto& [name, form] : forms) {
    SCOPED_TRACE (name);
    for (const bool is_turned : {false, true}) {
      Mesh given = form;
      if (is_turned)
        turnRound (given);
      TriangleMesh mesh = connected (given);
      EXPECT_EQ (faceOutwards (mesh, form.positions, {}, 1).turned, is_turned ? 1U : 0U);
      EXPECT_TRUE (mesh.triangles == form.triangles);
      expectConsistent (mesh);
    }
  }
}

// Bodies with windows, hollows, bodies within others, torn surfaces.
TEST (Facing, GeneratedSurfacesFaceAsTheyShould)
{
  for (const facing_cases::Family& family : facing_cases::FAMILIES)
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE (family.name + std::to_string (seed));
      const Mesh one = makeFacingCase (family, seed);
      TriangleMesh mesh = connected (one);
      const MeshComponents components = findComponents (mesh, 1);
      RandomStream random (seed);
      std::vector<std::uint8_t> is_turned (components.count);
      for (std::uint8_t& turned : is_turned)
        turned = static_cast<std::uint8_t> (random.below (2));
      for (std::size_t t = 0; t < mesh.triangles.size (); ++t)
        if (is_turned[components.of_triangle[t]] != 0)
          std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
      mesh.connect (one.positions.size (), 1);
      faceOutwards (mesh, one.positions, {}, 1);
      EXPECT_TRUE (mesh.triangles == one.triangles);
      expectConsistent (mesh);
    }
}

MeshFacing
faced (const Mesh& one, const FacingHints& hints = {})
{
  TriangleMesh mesh = connected (one);
  return faceOutwards (mesh, one.positions, hints, 1);
}

// Of a cap that is a share f of its sphere, the front sees all of the outside, the back 1 - f, and
// the mean normal is as long.
TEST (Facing, ACapIsSeenAsTheoryTells)
{
  for (const double share : {0.3, 0.5, 0.7, 0.9}) {
    const MeshFacing facing = faced (makeBowl (share));
    ASSERT_EQ (facing.objects.size (), 1U);
    const FacingObject& object = facing.objects.front ();
    EXPECT_EQ (object.rule, FacingRule::BODY);
    EXPECT_GT (object.front, 0.98);
    EXPECT_NEAR (object.back, 1.0 - share, 0.06);
    EXPECT_NEAR (object.mean_normal, 1.0 - share, 0.01);
    EXPECT_EQ (facing.turned, 0U);
  }
}

TEST (Facing, ABowlBecomesAValleyWhereItIsUnsure)
{
  const auto certaintyOf = [] (double share, std::size_t turned) {
    const MeshFacing facing = faced (makeBowl (share));
    EXPECT_EQ (facing.turned, turned);
    return facing.objects.front ().certainty;
  };
  EXPECT_EQ (certaintyOf (0.15, 1), 1.0); // it was outwards, which is down
  EXPECT_LT (certaintyOf (0.27, 0), 0.75);
  EXPECT_NEAR (certaintyOf (0.5, 0), 0.8, 0.05); // half a body may as well be a bowl
  EXPECT_GT (certaintyOf (0.8, 0), 0.9);
}

// Sensors that saw all of the surface are tested with the whole method.
TEST (Facing, ASensorFromWhichHalfOfABodyIsHiddenIsNotFaced)
{
  FacingHints hints;
  hints.sensor = Eigen::Vector3d (2.0, 1.0, 1.0);
  const MeshFacing facing = faced (makeFacingCase (facing_cases::FAMILIES[0], 1), hints);
  EXPECT_NE (facing.objects.front ().rule, FacingRule::SENSOR);
  EXPECT_EQ (facing.turned, 0U);
}

TEST (Facing, WhatOneViewHasShownIsTurnedTogether)
{
  // A bowl, whose inside was seen, and a sheet beside it.
  Mesh sheet = samples::sheet (10);
  turnRound (sheet);
  const Mesh both = beside (makeBowl (0.6), sheet);
  FacingHints hints;
  for (const bool is_one_view : {false, true}) {
    hints.is_one_view = is_one_view;
    const MeshFacing facing = faced (both, hints);
    EXPECT_EQ (facing.objects.size (), is_one_view ? 1U : 2U);
    EXPECT_EQ (facing.turned, is_one_view ? 0U : 1U);
  }
}

} // namespace
} // namespace pcl::floater
