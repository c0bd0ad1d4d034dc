// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is taken out at the boundary: folds beside it, and triangles that only fill its notches.
#include "mesh/open_boundary.h"

#include "mesh/flaw_repair.h"
#include "mesh/known_meshes.h"

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

// Squares of a strip of two rows, cut along diagonals; two triangles are turned over, as
// an inner point is moved across the boundary. Point x of row y is 7 y + x.
Mesh
foldedStrip ()
{
  Mesh mesh = samples::cells (6, 2, [] (Index x, Index y) { return Eigen::Vector3d (x, y, 0.0); });
  mesh.positions[10] = {3.0, -0.5, 0.0};
  return mesh;
}

// Equilateral triangles; rows of points, each shifted by half a triangle against the one before.
Mesh
honeycomb (Index columns, Index rows)
{
  Mesh mesh = samples::cells (columns, rows, [] (Index x, Index y) {
    return Eigen::Vector3d (x + (y % 2 == 0 ? 0.0 : 0.5), y * std::sqrt (0.75), 0.0);
  });
  for (std::size_t t = 0; t < mesh.triangles.size (); t += 2)
    if (t / 2 / columns % 2 == 0) { // the other diagonal
      const auto [a, b, d] = mesh.triangles[t];
      const Index c = mesh.triangles[t + 1][2];
      mesh.triangles[t] = {a, b, c};
      mesh.triangles[t + 1] = {b, d, c};
    }
  return mesh;
}

TEST (OpenBoundary, FlatAndClosedMeshesStay)
{
  for (const Mesh& mesh : {samples::sheet (9), honeycomb (8, 7), samples::annulus (12),
                           samples::torus (9, 7), Mesh ()}) {
    TriangleMesh changed = connected (mesh);
    EXPECT_EQ (openBoundaryFolds (changed, mesh.positions, 1), 0U);
    EXPECT_EQ (openNotches (changed, mesh.positions, NotchLimits (), 1), 0U);
    EXPECT_EQ (changed.triangles, mesh.triangles);
  }
}

TEST (BoundaryFolds, AsManyTrianglesBesideTheBoundaryAreTakenOutAsItNeeds)
{
  // A fan at the boundary point 0, whose second triangle is folded against the third one, so that
  // one triangle is not enough. Points 2 to 4 are inside.
  const Mesh fan{{{0, 0, 0},
                  {-1.3, -0.4, 2.1},
                  {-1.2, 0.2, 0.3},
                  {0.1, 0.7, 0.1},
                  {-2.2, -0.1, 0.3},
                  {-1, -0.5, 1.1},
                  {-3.5, 0.4, 0.8},
                  {-1.1, 0.6, 0.2}},
                 {{0, 1, 2},
                  {0, 2, 3},
                  {0, 3, 4},
                  {0, 4, 5},
                  {2, 1, 7},
                  {3, 2, 7},
                  {4, 3, 6},
                  {5, 4, 6},
                  {3, 7, 6}}};
  for (const Mesh& mesh : {foldedStrip (), fan}) {
    TriangleMesh changed = connected (mesh);
    ASSERT_GT (foldsOf (changed, mesh), 0U);
    // All folds end, no point is lost, and one boundary loop is left.
    EXPECT_EQ (openBoundaryFolds (changed, mesh.positions, 1), 2U);
    EXPECT_EQ (foldsOf (changed, mesh), 0U);
    samples::expectDisc (changed, mesh.positions.size ());
  }
}

TEST (BoundaryNotches, FillingsAreTakenOut)
{
  constexpr Index COLUMNS = 20, ROWS = 12;
  const Mesh mesh = honeycomb (COLUMNS, ROWS);
  Mesh filled = mesh;
  for (Index y = 1; y < ROWS; ++y) {
    const Index first = y * (COLUMNS + 1), last = first + COLUMNS;
    if (y % 2 == 1)
      filled.triangles.push_back ({first, first + COLUMNS + 1, first - COLUMNS - 1});
    else
      filled.triangles.push_back ({last, last - COLUMNS - 1, last + COLUMNS + 1});
  }
  TriangleMesh changed = connected (filled);
  EXPECT_EQ (openNotches (changed, filled.positions, NotchLimits (), 1), ROWS - 1U);
  EXPECT_EQ (changed.triangles, mesh.triangles);
}

// A sphere of uneven points, triangulated as a whole, and then cut: what is made of the points
// above the cut is the part of the mesh there.
TEST (BoundaryNotches, CutSurfacesEndWhereTheyAreCut)
{
  RandomStream random (5);
  samples::Positions sphere, above;
  constexpr int POINTS = 4000;
  for (int i = 0; i < POINTS; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / POINTS, angle = 2.399963229728653 * i;
    const double radius = std::sqrt (1.0 - z * z);
    const Eigen::Vector3d p (radius * std::cos (angle), radius * std::sin (angle), z);
    const Eigen::Vector3d jitter (random.normal (), random.normal (), random.normal ());
    sphere.push_back ((p + 0.008 * jitter).normalized ());
  }
  const auto isAbove = [&] (Index p) { return sphere[p].z () + 0.3 * sphere[p].x () > -0.4; };
  for (Index p = 0; p < sphere.size (); ++p)
    if (isAbove (p))
      above.push_back (sphere[p]);
  const Result whole = reconstruct (samples::asInput (sphere), Options ());
  ASSERT_TRUE (whole.report.check.loops.empty ());
  double expected = 0.0;
  for (const Triangle& t : whole.triangles)
    if (std::all_of (t.begin (), t.end (), isAbove))
      expected += samples::areaOf (t, sphere);
  const Result part = reconstruct (samples::asInput (above), Options ());
  EXPECT_EQ (part.report.check.loops.size (), 1U);
  EXPECT_NEAR (samples::areaOf (part.triangles, above) / expected, 1.0, 0.0015);
}

} // namespace
} // namespace pcl::floater
