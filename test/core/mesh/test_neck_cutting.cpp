// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Loops around necks, and necks that are cut.
#include "mesh/neck_cutting.h"

#include "mesh/known_meshes.h"
#include "mesh/neck_loops.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Mesh;

// Edges of the shortest loop; 0 if there is none.
std::size_t
shortestLoop (const Mesh& mesh, std::size_t longest)
{
  const TriangleMesh connected = samples::connected (mesh);
  const std::vector<std::vector<Index>> loops =
      findNeckLoops (connected, mesh.positions, longest, 1);
  for (const std::vector<Index>& loop : loops)
    for (std::size_t i = 0; i < loop.size (); ++i)
      EXPECT_TRUE (connected.hasEdge (loop[i], loop[(i + 1) % loop.size ()]));
  return loops.empty () ? 0 : loops.front ().size ();
}

TEST (NeckLoops, AreAsLongAsTheTubeIsWide)
{
  EXPECT_EQ (shortestLoop (samples::torus (15, 5), 4), 0U);
  for (const std::size_t longest : {5U, 8U, 12U})
    EXPECT_EQ (shortestLoop (samples::torus (15, 5), longest), 5U);
  for (const Index across : {3U, 4U})
    EXPECT_EQ (shortestLoop (samples::torus (36, across), 12), across);
}

TEST (NeckLoops, GoAroundNoTipAndNoBoundary)
{
  Mesh tip = samples::sheet (14);
  tip.positions[7 * 15 + 7].z () = 0.5;
  EXPECT_EQ (shortestLoop (tip, 12), 0U);
  EXPECT_EQ (shortestLoop (samples::annulus (5), 12), 0U);
  EXPECT_EQ (shortestLoop (samples::tetrahedron (), 12), 0U);
  EXPECT_EQ (shortestLoop (samples::torus (30, 13), 12), 0U); // hardly bent
}

LocalGeometry
geometryOf (const samples::TwoSheets& sheets, double spacing = 0.1)
{
  LocalGeometry geometry;
  geometry.neighbors = sheets.neighbors;
  geometry.spacing.assign (sheets.positions.size (), static_cast<float> (spacing));
  geometry.stars.normals = sheets.normals;
  return geometry;
}

// Two sheets face each other, and are joined by prisms in the places of some of their triangles.
samples::TwoSheets
joinedSheets (const std::vector<std::size_t>& places)
{
  constexpr Index SIDE = 14;
  Mesh lower = samples::sheet (SIDE), upper = lower;
  samples::turnRound (upper);
  for (Eigen::Vector3d& p : upper.positions)
    p.z () = 0.08;
  samples::TwoSheets sheets (lower, upper, 12);
  const std::size_t points = lower.positions.size (), triangles = lower.triangles.size ();
  std::fill (sheets.normals.begin () + static_cast<std::ptrdiff_t> (points), sheets.normals.end (),
             Eigen::Vector3f (0, 0, -1));
  samples::Triangles joined;
  for (std::size_t t = 0; t < 2 * triangles; ++t)
    if (std::count (places.begin (), places.end (), t % triangles) == 0)
      joined.push_back (sheets.mesh.triangles[t]);
  for (const std::size_t t : places)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = lower.triangles[t][i], q = lower.triangles[t][(i + 1) % 3];
      const auto above = [&] (Index r) { return static_cast<Index> (r + points); };
      joined.push_back ({p, q, above (q)});
      joined.push_back ({p, above (q), above (p)});
    }
  sheets.mesh = samples::connected (joined, sheets.positions.size ());
  return sheets;
}

// One bridge makes one component of two; each more makes a handle.
TEST (NeckCutting, CutsBridgesBetweenSheets)
{
  for (const std::vector<std::size_t>& places :
       {std::vector<std::size_t>{}, {180}, {95, 290}, {95, 290, 121, 268}}) {
    samples::TwoSheets sheets = joinedSheets (places);
    EXPECT_EQ (cutNecks (sheets.mesh, sheets.positions, geometryOf (sheets), {}, 1),
               places.size ());
    samples::expectConsistent (sheets.mesh);
    const samples::Topology topology = samples::topologyOf (sheets.mesh.triangles);
    EXPECT_EQ (topology.euler, 2);
    EXPECT_EQ (topology.components, 2U);
    EXPECT_EQ (topology.vertices, sheets.positions.size ());
    EXPECT_EQ (topology.loops.size (), 2U);
  }
}

TEST (NeckCutting, KeepsThinTubes)
{
  for (const Index across : {3U, 4U, 6U, 9U, 12U}) {
    const Mesh torus = samples::torus (8 * across / 3, across);
    samples::TwoSheets sheets (torus, {}, 12);
    sheets.normals.clear ();
    for (Index x = 0; x < torus.positions.size (); ++x) {
      const Eigen::Vector3d& p = torus.positions[x];
      const Eigen::Vector3d middle = Eigen::Vector3d (p.x (), p.y (), 0.0).normalized ();
      sheets.normals.push_back ((p - middle).normalized ().cast<float> ());
    }
    EXPECT_EQ (
        cutNecks (sheets.mesh, sheets.positions, geometryOf (sheets, 0.8 * PI / across), {}, 1),
        0U);
    samples::expectSame (sheets.mesh, samples::connected (torus));
  }
}

} // namespace
} // namespace pcl::floater
