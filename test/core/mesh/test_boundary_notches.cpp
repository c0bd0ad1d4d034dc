// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that only fill notches of the boundary.
#include "mesh/open_boundary.h"

#include "mesh/connected_mesh.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <random>

namespace pcl::floater {
namespace {
using samples::connected;
using samples::Mesh;

std::size_t
openNotches (TriangleMesh& mesh, const Mesh& of)
{
  return floater::openNotches (mesh, of.positions, NotchLimits (), 1);
}

// Equilateral triangles; rows of points, each shifted by half a triangle against the one before.
Mesh
honeycomb (Index columns, Index rows)
{
  Mesh mesh;
  for (Index y = 0; y <= rows; ++y)
    for (Index x = 0; x <= columns; ++x)
      mesh.positions.emplace_back (x + (y % 2 == 0 ? 0.0 : 0.5), y * std::sqrt (0.75), 0.0);
  for (Index y = 0; y < rows; ++y)
    for (Index x = 0; x < columns; ++x) {
      const Index a = y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
      if (y % 2 == 0) {
        mesh.triangles.push_back ({a, b, c});
        mesh.triangles.push_back ({b, d, c});
      }
      else {
        mesh.triangles.push_back ({a, d, c});
        mesh.triangles.push_back ({a, b, d});
      }
    }
  return mesh;
}

TEST (BoundaryNotches, AnglesAsInsideStay)
{
  for (const Mesh& mesh : {samples::sheet (9), honeycomb (8, 7), samples::annulus (12)}) {
    TriangleMesh changed = connected (mesh);
    EXPECT_EQ (openNotches (changed, mesh), 0U);
    EXPECT_EQ (changed.triangles, mesh.triangles);
  }
  // No boundary at all, or no triangle.
  for (const Mesh& mesh : {samples::torus (9, 7), Mesh ()}) {
    TriangleMesh changed = connected (mesh);
    EXPECT_EQ (openNotches (changed, mesh), 0U);
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
  EXPECT_EQ (openNotches (changed, filled), ROWS - 1U);
  EXPECT_EQ (changed.triangles, mesh.triangles);
}

TEST (BoundaryNotches, EveryPointKeepsATriangle)
{
  // A fan whose middle is its only inner point: the angles there are all of 120 degrees.
  Mesh fan;
  fan.positions = {{0, 0, 0}, {1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}};
  fan.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
  NotchLimits limits;
  limits.usual_share = 0.5; // so that these count as unusual
  TriangleMesh changed = connected (fan);
  EXPECT_EQ (floater::openNotches (changed, fan.positions, limits, 1), 1U);
  EXPECT_EQ (changed.triangles.size (), 2U);
  for (const Index t : changed.triangle_of)
    EXPECT_NE (t, NONE);
}

// A sphere of uneven points, triangulated as a whole, and then cut: what is made of the points
// above the cut is the part of the mesh there.
TEST (BoundaryNotches, CutSurfacesEndWhereTheyAreCut)
{
  std::mt19937 random (5);
  std::normal_distribution<double> step;
  samples::Positions sphere;
  constexpr int POINTS = 4000;
  for (int i = 0; i < POINTS; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / POINTS, angle = 2.399963229728653 * i;
    const double radius = std::sqrt (1.0 - z * z);
    const Eigen::Vector3d p (radius * std::cos (angle), radius * std::sin (angle), z);
    const Eigen::Vector3d jitter (step (random), step (random), step (random));
    sphere.push_back ((p + 0.008 * jitter).normalized ());
  }
  const Result whole = reconstruct (samples::asInput (sphere), Options ());
  ASSERT_TRUE (whole.report.check.loops.empty ());
  samples::Positions above;
  std::vector<Index> index (sphere.size (), NONE);
  for (std::size_t i = 0; i < sphere.size (); ++i)
    if (sphere[i].z () + 0.3 * sphere[i].x () > -0.4) {
      index[i] = static_cast<Index> (above.size ());
      above.push_back (sphere[i]);
    }
  const auto areaOf = [] (const samples::Positions& at, const Triangle& t) {
    return 0.5 * (at[t[1]] - at[t[0]]).cross (at[t[2]] - at[t[0]]).norm ();
  };
  double expected = 0.0, area = 0.0;
  for (const Triangle& t : whole.triangles)
    if (index[t[0]] != NONE && index[t[1]] != NONE && index[t[2]] != NONE)
      expected += areaOf (sphere, t);
  const Result part = reconstruct (samples::asInput (above), Options ());
  for (const Triangle& t : part.triangles)
    area += areaOf (above, t);
  EXPECT_EQ (part.report.check.loops.size (), 1U);
  EXPECT_NEAR (area / expected, 1.0, 0.0015);
}

} // namespace
} // namespace pcl::floater
