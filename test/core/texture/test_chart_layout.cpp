// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Charts, their layouts, and how these are measured.
#include "core/geometry.h"
#include "mesh/facing_cases.h"
#include "mesh/known_meshes.h"
#include "texture/chart_layout.h"
#include "texture/charts.h"
#include "texture/convex_layout.h"
#include "texture/smoothing.h"
#include "texture/stretch.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Mesh;

std::vector<Index>
allOf (const std::vector<Triangle>& triangles)
{
  return samples::indices (triangles.size ());
}

// Half a tube of radius 1, which can be laid out without stretch.
Mesh
halfTube (Index side)
{
  Mesh mesh = samples::sheet (side);
  for (Eigen::Vector3d& p : mesh.positions) {
    const double angle = PI * p.x () / (0.1 * side);
    p = Eigen::Vector3d (-std::cos (angle), p.y (), std::sin (angle));
  }
  return mesh;
}

TEST (Stretch, OfKnownMaps)
{
  const std::array<Eigen::Vector3d, 3> place{{{0, 0, 5}, {2, 0, 5}, {0, 2, 5}}};
  StretchSums same;
  same.add (place, {{{0, 0}, {1, 0}, {0, 1}}});
  EXPECT_DOUBLE_EQ (same.mean (), 1.0);
  EXPECT_DOUBLE_EQ (same.largest (), 1.0);
  EXPECT_DOUBLE_EQ (same.area (), 2.0);
  EXPECT_DOUBLE_EQ (same.planeArea (), 0.5);
  // Twice as wide in the plane as it is: singular values 1 and 1/2 of what they were.
  StretchSums wide;
  wide.add (place, {{{0, 0}, {2, 0}, {0, 1}}});
  EXPECT_DOUBLE_EQ (wide.mean (), std::sqrt (0.5 * (1.0 + 4.0) / 2.0));
  EXPECT_DOUBLE_EQ (wide.largest (), std::sqrt (2.0));
  // Sheared by one.
  StretchSums sheared;
  sheared.add (place, {{{0, 0}, {1, 0}, {1, 1}}});
  EXPECT_DOUBLE_EQ (sheared.mean (), std::sqrt (1.5));
  EXPECT_NEAR (sheared.largest (), 0.5 * (1.0 + std::sqrt (5.0)), 1e-12);
  // One triangle is four times as large in the plane as another one.
  StretchSums both = same;
  StretchSums other;
  other.add (place, {{{0, 0}, {2, 0}, {0, 2}}});
  both.add (other);
  EXPECT_DOUBLE_EQ (both.mean (), std::sqrt (0.5 * (4.0 + 1.0) * 2.5 / 4.0));
  // Flipped: infinite. Without an area in space: not counted.
  StretchSums flipped;
  flipped.add (place, {{{0, 0}, {0, 1}, {1, 0}}});
  EXPECT_TRUE (std::isinf (flipped.mean ()));
  EXPECT_TRUE (std::isinf (flipped.largest ()));
  StretchSums line;
  line.add ({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}, {{{0, 0}, {1, 0}, {0, 1}}});
  EXPECT_EQ (line.mean (), 1.0);
}

TEST (ChartMesh, LoopOfADiscOnly)
{
  const Mesh sheet = samples::sheet (4);
  const ChartMesh chart = makeChartMesh (sheet.triangles, allOf (sheet.triangles), sheet.positions);
  EXPECT_EQ (chart.loop.size (), 16U);
  EXPECT_EQ (chart.loop.front (), 0U);
  EXPECT_EQ (chart.loop[1], 1U);
  for (const Mesh& none : {samples::annulus (8), samples::torus (9, 7), samples::tetrahedron ()})
    EXPECT_TRUE (
        makeChartMesh (none.triangles, allOf (none.triangles), none.positions).loop.empty ());
  // Two triangles that meet at a point.
  EXPECT_TRUE (makeChartMesh (sheet.triangles, {0, 10}, sheet.positions).loop.empty ());
}

TEST (ConvexLayout, IsUprightInTheCircle)
{
  for (const double share : {0.3, 0.7, 0.95}) {
    const facing_cases::FacingCase bowl = facing_cases::makeBowl (share);
    const ChartMesh chart =
        makeChartMesh (bowl.mesh.triangles, allOf (bowl.mesh.triangles), bowl.positions);
    ASSERT_FALSE (chart.loop.empty ());
    const PlaneLayout layout = layOutOnCircle (chart, makeRestShapes (chart), 1);
    ASSERT_EQ (layout.uv.size (), chart.positions.size ());
    EXPECT_TRUE (isUpright (chart.mesh.triangles, layout.uv));
    EXPECT_TRUE (isSimple (chart.loop, layout.uv));
    for (const Index p : chart.loop)
      EXPECT_NEAR (layout.uv[p].norm (), 1.0, 1e-9);
  }
}

TEST (DistortionDescent, DevelopsWhatCanBeDeveloped)
{
  const Mesh tube = halfTube (12);
  const ChartMesh chart = makeChartMesh (tube.triangles, allOf (tube.triangles), tube.positions);
  const RestShapes rest = makeRestShapes (chart);
  std::vector<Eigen::Vector2d> uv = layOutOnCircle (chart, rest, 1).uv;
  DescentLimits limits;
  limits.steps = 500;
  limits.least_progress = 1e-9;
  descendDistortion (chart, rest, limits, 1, uv);
  StretchSums sums;
  for (const Triangle& t : chart.mesh.triangles)
    sums.add ({chart.positions[t[0]], chart.positions[t[1]], chart.positions[t[2]]},
              {uv[t[0]], uv[t[1]], uv[t[2]]});
  EXPECT_NEAR (sums.mean (), 1.0, 1e-4);
  EXPECT_TRUE (isUpright (chart.mesh.triangles, uv));
}

// A deep bag on the circle: what lies near its bottom is all but a point, and no step of L-BFGS is
// long. Newton's method helps, however many triangles a chart has.
TEST (DistortionDescent, GetsOnWhereTrianglesAreAllButDegenerate)
{
  constexpr Index RINGS = 120, ROUND = 16;
  samples::Positions positions{{0.0, 0.0, -0.5}};
  std::vector<Triangle> triangles;
  for (Index i = 0; i < RINGS; ++i)
    for (Index j = 0; j < ROUND; ++j) {
      const double angle = 2.0 * PI * j / ROUND;
      positions.emplace_back (std::cos (angle), std::sin (angle), 0.4 * i);
      const Index p = 1 + i * ROUND + j, q = 1 + i * ROUND + (j + 1) % ROUND;
      if (i == 0)
        triangles.push_back ({0, p, q});
      else {
        triangles.push_back ({p - ROUND, p, q});
        triangles.push_back ({p - ROUND, q, q - ROUND});
      }
    }
  const ChartMesh chart = makeChartMesh (triangles, allOf (triangles), positions);
  const RestShapes rest = makeRestShapes (chart);
  std::vector<Eigen::Vector2d> uv = layOutOnCircle (chart, rest, 1).uv;
  ASSERT_FALSE (uv.empty ());
  const auto stretchNow = [&] {
    StretchSums sums;
    for (const Triangle& t : chart.mesh.triangles)
      sums.add ({chart.positions[t[0]], chart.positions[t[1]], chart.positions[t[2]]},
                {uv[t[0]], uv[t[1]], uv[t[2]]});
    return sums.mean ();
  };
  const double before = stretchNow ();
  DescentLimits limits;
  limits.most_newton_triangles = 0;
  descendDistortion (chart, rest, limits, 1, uv);
  EXPECT_LT (stretchNow (), 0.5 * before) << before;
  EXPECT_TRUE (isUpright (chart.mesh.triangles, uv));
}

TEST (DistortionDescent, ExactChecks)
{
  const std::vector<Eigen::Vector2d> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_TRUE (isSimple ({0, 1, 2, 3}, square));
  EXPECT_FALSE (isSimple ({0, 2, 1, 3}, square));
  EXPECT_TRUE (isUpright ({{0, 1, 2}, {0, 2, 3}}, square));
  EXPECT_FALSE (isUpright ({{0, 1, 2}, {0, 3, 2}}, square));
  const double nan = std::nan ("");
  EXPECT_FALSE (isUpright ({{0, 1, 2}}, {{0, 0}, {1, 0}, {nan, 1}}));
  EXPECT_FALSE (isSimple ({0, 1, 2}, {{0, 0}, {1, 0}, {nan, 1}}));
  // A sliver that only exact arithmetic can tell from a line: the last corner is one step above it.
  const double above = std::nextafter (0.1, 1.0);
  EXPECT_TRUE (isUpright ({{0, 1, 2}}, {{0.1, 0.1}, {0.3, 0.3}, {0.1, above}}));
  EXPECT_FALSE (isUpright ({{0, 1, 2}}, {{0.1, 0.1}, {0.3, 0.3}, {0.2, 0.2}}));
}

TEST (ChartLayout, FlatAndCurved)
{
  const Mesh sheet = samples::sheet (8);
  const ChartLayout flat =
      layOutChart (sheet.triangles, allOf (sheet.triangles), sheet.positions, {}, 1);
  EXPECT_NEAR (flat.stretch, 1.0, 1e-6);
  EXPECT_NEAR (flat.area, 0.64, 1e-9);
  const Mesh tube = halfTube (16);
  EXPECT_LT (layOutChart (tube.triangles, allOf (tube.triangles), tube.positions, {}, 1).stretch,
             1.01);
  // No disc: no layout.
  const Mesh ring = samples::annulus (8);
  const ChartLayout none =
      layOutChart (ring.triangles, allOf (ring.triangles), ring.positions, {}, 1);
  EXPECT_TRUE (none.uv.empty ());
  EXPECT_TRUE (none.loop.empty ());
}

// A flat spiral staircase of one and a half turns: its projection lies above itself.
TEST (ChartLayout, NothingLiesAboveItself)
{
  Mesh stairs = samples::grid (
      60, 4, 61 * 5, [] (Index x, Index y) { return y * 61 + x; },
      [] (Index x, Index y) {
        const double angle = 3.0 * PI * x / 60.0, radius = 2.0 - 0.3 * y;
        return Eigen::Vector3d (radius * std::cos (angle), radius * std::sin (angle), 0.02 * x);
      });
  const ChartLayout layout =
      layOutChart (stairs.triangles, allOf (stairs.triangles), stairs.positions, {}, 1);
  ASSERT_FALSE (layout.uv.empty ());
  EXPECT_TRUE (isSimple (layout.loop, layout.uv));
  EXPECT_TRUE (isUpright (layout.corners, layout.uv));
}

TEST (Charts, AreDiscsAndEndAtCreases)
{
  // A roof: two slopes of 45 degrees.
  Mesh roof = samples::sheet (10);
  for (Eigen::Vector3d& p : roof.positions)
    p.z () = -std::abs (p.x () - 0.5);
  TriangleMesh mesh;
  mesh.triangles = roof.triangles;
  ASSERT_TRUE (mesh.connect (roof.positions.size (), 1));
  const MeshParts charts = findCharts (mesh, roof.positions, {}, {}, 1);
  EXPECT_EQ (charts.count, 2U);
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
    double x = 0.0;
    for (const Index p : mesh.triangles[t])
      x += roof.positions[p].x () / 3.0;
    EXPECT_EQ (charts.of_triangle[t], x < 0.5 ? charts.of_triangle[0] : 1 - charts.of_triangle[0]);
  }
  // If it has to be cut all the same, in two.
  const Mesh sheet = samples::sheet (10);
  mesh.triangles = sheet.triangles;
  ASSERT_TRUE (mesh.connect (sheet.positions.size (), 1));
  EXPECT_EQ (findCharts (mesh, sheet.positions, {0.5, 1}, {}, 1).count, 1U);
  EXPECT_EQ (findCharts (mesh, sheet.positions, {0.5, 2}, {}, 1).count, 2U);
}

TriangleMesh
connect (const Mesh& mesh)
{
  TriangleMesh connected;
  connected.triangles = mesh.triangles;
  EXPECT_TRUE (connected.connect (mesh.positions.size (), 1));
  return connected;
}

TEST (Smoothing, MovesNoiseOnly)
{
  // Bodies, saddles and creases stay to the last bit.
  Mesh roof = samples::sheet (10);
  for (Eigen::Vector3d& p : roof.positions)
    p.z () = std::abs (p.x () - 0.5) - std::abs (p.y () - 0.5);
  for (const Mesh& mesh : {samples::torus (40, 16), samples::tetrahedron (), roof})
    EXPECT_EQ (smoothNoise (connect (mesh), mesh.positions, {}, 1), mesh.positions);

  Mesh noisy = samples::sheet (20);
  RandomStream random (1);
  for (Eigen::Vector3d& p : noisy.positions)
    p.z () = 0.05 * random.normal ();
  const auto roughness = [] (const samples::Positions& positions) {
    double sum = 0.0;
    for (const Eigen::Vector3d& p : positions)
      sum += p.z () * p.z ();
    return std::sqrt (sum / static_cast<double> (positions.size ()));
  };
  const samples::Positions smooth = smoothNoise (connect (noisy), noisy.positions, {}, 1);
  EXPECT_LT (roughness (smooth), 0.5 * roughness (noisy.positions));
  EXPECT_EQ (smoothNoise (connect (noisy), noisy.positions, {}, 3), smooth);
  // So it is one chart, or few.
  const TriangleMesh mesh = connect (noisy);
  EXPECT_LE (findCharts (mesh, smooth, {}, {}, 1).count, 2U);
}

// Depth that is measured in steps: flat between them.
TEST (Smoothing, LevelsSteps)
{
  Mesh steps = samples::sheet (24);
  for (Eigen::Vector3d& p : steps.positions)
    p.z () = 0.3 * std::floor (p.x () / 0.4 + 0.1 * std::sin (20.0 * p.y ()));
  const samples::Positions smooth = smoothNoise (connect (steps), steps.positions, {}, 1);
  const auto steepest = [&] (const samples::Positions& positions) {
    std::vector<double> tilts;
    for (const Triangle& t : steps.triangles)
      tilts.push_back (areaVector (positions[t[0]], positions[t[1]], positions[t[2]])
                           .normalized ()
                           .head<2> ()
                           .norm ());
    std::sort (tilts.begin (), tilts.end ());
    return tilts[tilts.size () * 9 / 10];
  };
  EXPECT_GT (steepest (steps.positions), 0.9);
  EXPECT_LT (steepest (smooth), 0.85);
}

// A vertex of one triangle does not come to lie between its neighbours.
TEST (Smoothing, LeavesAreaToTrianglesAtCorners)
{
  Mesh noisy = samples::sheet (12);
  RandomStream random (5);
  for (Eigen::Vector3d& p : noisy.positions)
    p.z () = 0.1 * random.normal ();
  const samples::Positions smooth = smoothNoise (connect (noisy), noisy.positions, {}, 1);
  for (const Triangle& t : noisy.triangles)
    EXPECT_GT (areaVector (smooth[t[0]], smooth[t[1]], smooth[t[2]]).norm (), 1e-4);
}

TEST (Untangling, UndoesDetailsOnly)
{
  const Mesh sheet = samples::sheet (12);
  const ChartMesh chart = makeChartMesh (sheet.triangles, allOf (sheet.triangles), sheet.positions);
  std::vector<Eigen::Vector2d> flat;
  for (const Eigen::Vector3d& p : chart.positions)
    flat.emplace_back (p.x (), p.y ());
  std::vector<Eigen::Vector2d> uv = flat;
  EXPECT_TRUE (untangle (chart, {}, 1, uv));
  EXPECT_EQ (uv, flat); // nothing to do
  // An inner vertex and one of the boundary are pulled across the triangles around them.
  uv[6 * 13 + 6] += Eigen::Vector2d (0.25, 0.03);
  uv[6] += Eigen::Vector2d (0.02, 0.25);
  ASSERT_FALSE (isUpright (chart.mesh.triangles, uv));
  ASSERT_TRUE (untangle (chart, {}, 1, uv));
  EXPECT_TRUE (isUpright (chart.mesh.triangles, uv));
  EXPECT_TRUE (isSimple (chart.loop, uv));
  EXPECT_EQ (uv.back (), flat.back ()); // far away
  // All of it upside down.
  uv = flat;
  for (Eigen::Vector2d& p : uv)
    p.x () = -p.x ();
  EXPECT_FALSE (untangle (chart, {}, 1, uv));
}

TEST (ChartLayout, RefinedForOtherPositions)
{
  // Made for a sheet, of which one half is twice as long in fact.
  const Mesh sheet = samples::sheet (10);
  ChartLayout layout =
      layOutChart (sheet.triangles, allOf (sheet.triangles), sheet.positions, {}, 1);
  samples::Positions longer = sheet.positions;
  for (Eigen::Vector3d& p : longer)
    p.x () += std::max (0.0, p.x () - 0.5);
  ASSERT_TRUE (refineLayout (sheet.triangles, longer, {}, 1, layout));
  EXPECT_NEAR (layout.stretch, 1.0, 0.01);
  EXPECT_TRUE (isUpright (layout.corners, layout.uv));
  // It cannot be better.
  const std::vector<Eigen::Vector2d> before =
      layOutChart (sheet.triangles, allOf (sheet.triangles), sheet.positions, {}, 1).uv;
  ChartLayout same = layOutChart (sheet.triangles, allOf (sheet.triangles), sheet.positions, {}, 1);
  if (!refineLayout (sheet.triangles, sheet.positions, {}, 1, same)) {
    EXPECT_EQ (same.uv, before);
  }
  EXPECT_NEAR (same.stretch, 1.0, 1e-6);
}

// A rolled sheet has no projection, and its boundary crosses itself in each. Where it is too large
// for a circle, it has no layout.
TEST (ChartLayout, LargeOnesAreNotBegunOnACircle)
{
  constexpr Index LENGTH = 80, WIDTH = 8;
  samples::Positions positions;
  std::vector<Triangle> triangles;
  for (Index i = 0; i < LENGTH; ++i)
    for (Index j = 0; j < WIDTH; ++j) {
      const double angle = 0.2 * i, radius = 1.0 + 0.1 * angle;
      positions.emplace_back (radius * std::cos (angle), radius * std::sin (angle), 0.2 * j);
      if (i + 1 < LENGTH && j + 1 < WIDTH) {
        const Index p = i * WIDTH + j, q = p + WIDTH;
        triangles.push_back ({p, q, q + 1});
        triangles.push_back ({p, q + 1, p + 1});
      }
    }
  DescentLimits limits;
  limits.most_on_circle = triangles.size ();
  EXPECT_FALSE (layOutChart (triangles, allOf (triangles), positions, limits, 1).uv.empty ());
  --limits.most_on_circle;
  EXPECT_TRUE (layOutChart (triangles, allOf (triangles), positions, limits, 1).uv.empty ());
}

// Facets of several triangles, as large meshes have them.
TEST (Charts, FacetsAreDiscs)
{
  const facing_cases::FacingCase body =
      facing_cases::makeFacingCase (facing_cases::Family::WINGED_BODY, 3);
  ChartLimits limits;
  limits.facets = 200;
  const MeshParts facets =
      growFacets (body.mesh, body.positions, areaVectors (body.mesh, body.positions, 1), limits, 1);
  EXPECT_GT (facets.count, body.mesh.triangles.size () / limits.most_in_facet);
  std::vector<std::vector<Index>> lists (facets.count);
  for (std::size_t t = 0; t < facets.of_triangle.size (); ++t)
    lists[facets.of_triangle[t]].push_back (static_cast<Index> (t));
  for (const std::vector<Index>& facet : lists) {
    EXPECT_LE (facet.size (), limits.most_in_facet);
    EXPECT_FALSE (makeChartMesh (body.mesh.triangles, facet, body.positions).loop.empty ());
  }
}

} // namespace
} // namespace pcl::floater
