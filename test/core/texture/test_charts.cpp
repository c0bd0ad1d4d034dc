// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Charts, their layouts, and how these are measured.
#include "core/geometry.h"
#include "mesh/known_meshes.h"
#include "texture/chart_layout.h"
#include "texture/charts.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;
using Plane = std::vector<Eigen::Vector2d>;

MeshPiece
chartOf (const Mesh& mesh)
{
  return cutOut (mesh.triangles, indices (mesh.triangles.size ()), mesh.positions);
}

ChartLayout
layOut (const Mesh& mesh, const DescentLimits& limits = {})
{
  return layOutChart (mesh.triangles, indices (mesh.triangles.size ()), mesh.positions, limits, 1);
}

double
meanStretch (const MeshPiece& chart, const Plane& uv)
{
  const std::vector<Triangle>& triangles = chart.mesh.triangles;
  return stretchOf (triangles, chart.positions, triangles, uv).mean ();
}

TEST (Stretch, OfKnownMaps)
{
  const std::array<Eigen::Vector3d, 3> place{{{0, 0, 5}, {2, 0, 5}, {0, 2, 5}}};
  StretchSums sums; // of one triangle each time
  // Twice as wide in the plane as it is: singular values 1 and 1/2 of what they were.
  sums.add (place, {{{0, 0}, {2, 0}, {0, 1}}});
  EXPECT_DOUBLE_EQ (sums.mean (), std::sqrt (0.5 * (1.0 + 4.0) / 2.0));
  EXPECT_DOUBLE_EQ (sums.largest (), std::sqrt (2.0));
  sums = {};
  sums.add (place, {{{0, 0}, {1, 0}, {1, 1}}}); // sheared by one
  EXPECT_DOUBLE_EQ (sums.mean (), std::sqrt (1.5));
  EXPECT_NEAR (sums.largest (), 0.5 * (1.0 + std::sqrt (5.0)), 1e-12);
  // Flipped: infinite. Without an area in space: not counted.
  sums = {};
  sums.add (place, {{{0, 0}, {0, 1}, {1, 0}}});
  EXPECT_TRUE (std::isinf (sums.mean ()) && std::isinf (sums.largest ()));
  sums = {};
  sums.add ({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}, {{{0, 0}, {1, 0}, {0, 1}}});
  EXPECT_EQ (sums.mean (), 1.0);
}

TEST (MeshPiece, LoopOfADiscOnly)
{
  const Mesh sheet = samples::sheet (4);
  const std::vector<Index> loop = chartOf (sheet).loop;
  EXPECT_EQ (loop.size (), 16U);
  EXPECT_EQ (loop[0], 0U);
  EXPECT_EQ (loop[1], 1U);
  // Two triangles that meet at a point are no disc, either.
  const Mesh two{sheet.positions, {sheet.triangles[0], sheet.triangles[10]}};
  for (const Mesh& none : {annulus (8), torus (9, 7), tetrahedron (), two})
    EXPECT_TRUE (chartOf (none).loop.empty () && layOut (none).uv.empty ());
}

TEST (DistortionDescent, DevelopsWhatCanBeDeveloped)
{
  Mesh tube = sheet (12); // half of one
  for (Eigen::Vector3d& p : tube.positions) {
    const double angle = PI * p.x () / 1.2;
    p = Eigen::Vector3d (-std::cos (angle), p.y (), std::sin (angle));
  }
  const MeshPiece chart = chartOf (tube);
  const RestShapes rest = makeRestShapes (chart);
  Plane uv = layOutOnCircle (chart, 1);
  DescentLimits limits;
  limits.steps = 500;
  limits.least_progress = 1e-9;
  descendDistortion (chart, rest, limits, 1, uv);
  EXPECT_NEAR (meanStretch (chart, uv), 1.0, 1e-4);
  EXPECT_TRUE (isUpright (chart.mesh.triangles, uv));
}

// A deep bag on the circle: what lies near its bottom is all but a point, and no step by the
// Laplacian is long. Newton's method helps.
TEST (DistortionDescent, GetsOnWhereTrianglesAreAllButDegenerate)
{
  constexpr Index RINGS = 120, ROUND = 16;
  Mesh bag = grid (
      ROUND, RINGS, 1 + RINGS * ROUND, // the lowest ring is one point
      [] (Index x, Index y) { return y == 0 ? 0 : 1 + (y - 1) * ROUND + x % ROUND; },
      [] (Index x, Index y) {
        return y == 0 ? polar (0.0, 0.0, -0.5) : polar (1.0, 2.0 * PI * x / ROUND, 0.4 * (y - 1));
      });
  bag.triangles.erase (std::remove_if (bag.triangles.begin (), bag.triangles.end (),
                                       [] (const Triangle& t) { return t[0] == t[1]; }),
                       bag.triangles.end ());
  const MeshPiece chart = chartOf (bag);
  const RestShapes rest = makeRestShapes (chart);
  Plane uv = layOutOnCircle (chart, 1);
  ASSERT_EQ (uv.size (), chart.positions.size ());
  for (const Index p : chart.loop)
    EXPECT_NEAR (uv[p].norm (), 1.0, 1e-9);
  const double before = meanStretch (chart, uv);
  descendDistortion (chart, rest, {}, 1, uv);
  EXPECT_LT (meanStretch (chart, uv), 0.5 * before) << before;
  EXPECT_TRUE (isUpright (chart.mesh.triangles, uv));
}

TEST (DistortionDescent, ExactChecks)
{
  const Plane square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
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

TEST (ChartLayout, RefinedForOtherPositions)
{
  // Made for a sheet, of which one half is twice as long in fact.
  const Mesh sheet = samples::sheet (10);
  ChartLayout layout = layOut (sheet);
  const Plane before = layout.uv;
  refineLayout (sheet.positions, {}, 1, layout); // which cannot be better
  EXPECT_EQ (layout.uv, before);
  EXPECT_NEAR (layout.stretch, 1.0, 1e-6);
  Positions longer = sheet.positions;
  for (Eigen::Vector3d& p : longer)
    p.x () += std::max (0.0, p.x () - 0.5);
  refineLayout (longer, {}, 1, layout);
  EXPECT_NEAR (layout.stretch, 1.0, 0.01);
  EXPECT_TRUE (isUpright (layout.chart.mesh.triangles, layout.uv));
}

// A flat spiral staircase of one and a half turns: its projection lies above itself. A rolled sheet
// has no projection, and its boundary crosses itself in each: it is begun on a circle, but if it is
// too large for that, it has no layout.
TEST (ChartLayout, NothingLiesAboveItself)
{
  const Mesh stairs = cells (60, 4, [] (Index x, Index y) {
    return polar (2.0 - 0.3 * y, 3.0 * PI * x / 60.0, 0.02 * x);
  });
  const Mesh roll = cells (7, 79, [] (Index x, Index y) {
    const double angle = 0.2 * y;
    return polar (1.0 + 0.1 * angle, angle, 0.2 * x);
  });
  DescentLimits limits;
  limits.most_on_circle = roll.triangles.size ();
  for (const ChartLayout& layout : {layOut (stairs), layOut (roll, limits)}) {
    ASSERT_FALSE (layout.uv.empty ());
    EXPECT_TRUE (isSimple (layout.chart.loop, layout.uv));
    EXPECT_TRUE (isUpright (layout.chart.mesh.triangles, layout.uv));
  }
  --limits.most_on_circle;
  EXPECT_TRUE (layOut (roll, limits).uv.empty ());
}

TEST (Charts, AreCutInTwoIfTheyHaveToBe)
{
  const Mesh sheet = samples::sheet (10);
  EXPECT_EQ (findCharts (connected (sheet), sheet.positions, {}, 1).count, 1U);
  ChartLimits limits;
  limits.halves = true;
  EXPECT_EQ (findCharts (connected (sheet), sheet.positions, limits, 1).count, 2U);
}

// Facets of several triangles, as large meshes have them.
TEST (Charts, FacetsAreDiscs)
{
  const Mesh body = makeFacingCase (facing_cases::FAMILIES[0], 3);
  const TriangleMesh mesh = connected (body);
  ChartLimits limits;
  limits.facets = 200;
  const MeshComponents facets =
      growFacets (mesh, body.positions, areaVectors (mesh, body.positions, 1), limits, 1);
  EXPECT_GT (facets.count, body.triangles.size () / limits.most_in_facet);
  std::vector<std::vector<Index>> lists (facets.count);
  for (std::size_t t = 0; t < facets.of_triangle.size (); ++t)
    lists[facets.of_triangle[t]].push_back (static_cast<Index> (t));
  for (const std::vector<Index>& facet : lists) {
    EXPECT_LE (facet.size (), limits.most_in_facet);
    EXPECT_FALSE (cutOut (body.triangles, facet, body.positions).loop.empty ());
  }
}

TEST (Smoothing, MovesNoiseOnly)
{
  // Bodies, saddles and creases stay to the last bit.
  Mesh roof = sheet (10);
  for (Eigen::Vector3d& p : roof.positions)
    p.z () = std::abs (p.x () - 0.5) - std::abs (p.y () - 0.5);
  for (const Mesh& mesh : {torus (40, 16), tetrahedron (), roof})
    EXPECT_EQ (smoothNoise (connected (mesh), mesh.positions, 1), mesh.positions);

  Mesh noisy = noisySheet (20, 0.05, 1);
  const auto sumOfSquares = [] (const Positions& positions) {
    double sum = 0.0;
    for (const Eigen::Vector3d& p : positions)
      sum += p.z () * p.z ();
    return sum;
  };
  Positions smooth = smoothNoise (connected (noisy), noisy.positions, 1);
  EXPECT_LT (sumOfSquares (smooth), 0.25 * sumOfSquares (noisy.positions));
  // So it is one chart, or few.
  EXPECT_LE (findCharts (connected (noisy), smooth, {}, 1).count, 2U);
  // A vertex of one triangle, at a corner, does not come to lie between its neighbours.
  noisy = noisySheet (12, 0.1, 5);
  smooth = smoothNoise (connected (noisy), noisy.positions, 1);
  for (const Triangle& t : noisy.triangles)
    EXPECT_GT (areaVector (smooth[t[0]], smooth[t[1]], smooth[t[2]]).norm (), 1e-4);
}

// Depth that is measured in steps: flat between them.
TEST (Smoothing, LevelsSteps)
{
  Mesh steps = sheet (24);
  for (Eigen::Vector3d& p : steps.positions)
    p.z () = 0.3 * std::floor (p.x () / 0.4 + 0.1 * std::sin (20.0 * p.y ()));
  const auto steepest = [&] (const Positions& positions) {
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
  EXPECT_LT (steepest (smoothNoise (connected (steps), steps.positions, 1)), 0.85);
}

TEST (Untangling, UndoesDetailsOnly)
{
  const MeshPiece chart = chartOf (sheet (12));
  Plane flat;
  for (const Eigen::Vector3d& p : chart.positions)
    flat.emplace_back (p.x (), p.y ());
  Plane uv = flat;
  EXPECT_TRUE (untangle (chart, 1, uv));
  EXPECT_EQ (uv, flat); // nothing to do
  // An inner vertex and one of the boundary are pulled across the triangles around them.
  uv[6 * 13 + 6] += Eigen::Vector2d (0.25, 0.03);
  uv[6] += Eigen::Vector2d (0.02, 0.25);
  ASSERT_FALSE (isUpright (chart.mesh.triangles, uv));
  ASSERT_TRUE (untangle (chart, 1, uv));
  EXPECT_TRUE (isUpright (chart.mesh.triangles, uv));
  EXPECT_TRUE (isSimple (chart.loop, uv));
  EXPECT_EQ (uv.back (), flat.back ()); // far away
  // All of it upside down.
  uv = flat;
  for (Eigen::Vector2d& p : uv)
    p.x () = -p.x ();
  EXPECT_FALSE (untangle (chart, 1, uv));
}

} // namespace
} // namespace pcl::floater
