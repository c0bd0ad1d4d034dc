// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The examination of known meshes, sound and broken, and what the report says about it.
#include "mesh/known_meshes.h"
#include "report/findings.h"
#include "report/report_mesh.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

// Expects a sound mesh of this topology.
void
expectSound (const Mesh& mesh, std::size_t components, std::int64_t euler, std::int64_t genus,
             const std::vector<std::size_t>& loop_points)
{
  const MeshExamination found = check (mesh);
  const MeshCheck& c = found.check;
  EXPECT_TRUE (c.done);
  EXPECT_TRUE (found.isManifold ());
  EXPECT_EQ (found.figures.broken.at, NONE);
  EXPECT_EQ (c.components, components);
  EXPECT_EQ (c.euler_characteristic, euler);
  EXPECT_EQ (c.genus, genus);
  ASSERT_EQ (c.loops.size (), loop_points.size ());
  ASSERT_EQ (found.loops.size (), loop_points.size ());
  for (std::size_t i = 0; i < loop_points.size (); ++i) {
    EXPECT_EQ (c.loops[i].points, loop_points[i]);
    EXPECT_EQ (found.loops[i].points.size (), loop_points[i]);
  }
  EXPECT_EQ (c.degenerate_triangles, 0U);
  // The same as by an independent count, and by TriangleMesh.
  const MeshTopology topology = topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (c.components, topology.components);
  EXPECT_EQ (c.euler_characteristic, topology.euler);
  EXPECT_EQ (found.unused.size (), mesh.positions.size () - topology.vertices);
  EXPECT_EQ (boundaryLoops (connected (mesh), 1), topology.loops);
  std::vector<std::vector<Index>> loops;
  for (const BoundaryLoop& loop : found.loops)
    loops.push_back (loop.points);
  std::sort (loops.begin (), loops.end ());
  EXPECT_EQ (loops, topology.loops);
}

TEST (MeshCheck, KnownSurfaces)
{
  expectSound (tetrahedron (), 1, 2, 0, {});
  expectSound (torus (20, 9), 1, 0, 1, {});
  expectSound (torus (300, 150), 1, 0, 1, {}); // points and triangles in several ranges
  expectSound (sheet (6), 1, 1, 0, {24});
  expectSound (annulus (30), 1, 0, 0, {30, 30});
  expectSound (beside (torus (12, 8), annulus (40)), 2, 0, 1, {40, 40});
  expectSound (beside (sheet (3), tetrahedron ()), 2, 3, 0, {12});
  Mesh holed = torus (20, 9); // without one triangle, and with a point that no triangle uses
  holed.triangles.erase (holed.triangles.begin () + 100);
  holed.positions.emplace_back (0, 0, 0);
  expectSound (holed, 1, -1, 1, {3});
  EXPECT_EQ (check (holed).unused, (std::vector<Index>{180}));
  const Mesh nothing{{{0, 0, 0}, {1, 0, 0}}, {}};
  expectSound (nothing, 0, 0, 0, {});
  expectSound ({}, 0, 0, 0, {});
}

TEST (MeshCheck, LoopsHaveTheirComponentsAndTheirSizeInTheCloud)
{
  constexpr Index AROUND = 40;
  const MeshExamination found = check (beside (sheet (3), annulus (AROUND)));
  EXPECT_EQ (found.component_points, (std::vector<std::size_t>{16, 200}));
  EXPECT_EQ (found.smallest_component, 16U);
  EXPECT_EQ (found.smallest_component_at, 0U);
  EXPECT_EQ (found.largest_component, 200U);
  ASSERT_EQ (found.loops.size (), 3U);
  EXPECT_EQ (found.loops[2].component, 0U);
  const double chord = 2.0 * std::sin (PI / AROUND);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ (found.loops[i].component, 1U);
    const LoopSummary& loop = found.check.loops[i];
    const double radius = i == 0 ? 1.0 : 0.5;
    EXPECT_NEAR (loop.length, 10.0 * radius * AROUND * chord, 1e-9);
    EXPECT_NEAR (loop.width, 10.0 * radius * 2.0, 1e-9);
    EXPECT_NEAR (loop.width_spacings, radius * 2.0 / 0.1, 1e-4);
    EXPECT_EQ (loop.at, 3 * (16 + (i == 0 ? 0U : 4 * AROUND)) + 1);
  }
}

TEST (MeshCheck, WhatIsNoManifoldIsNotConnected)
{
  const Triangles bodies{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                         {0, 5, 4}, {0, 4, 6}, {4, 5, 6}, {5, 0, 6}};
  const std::vector<std::pair<const char*, Triangles>> cases = {
      {"three triangles at an edge", {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}},
      {"wound against each other", {{0, 1, 2}, {0, 1, 3}}},
      {"a bow tie", {{0, 1, 2}, {0, 3, 4}}},
      {"two closed fans at a vertex", bodies},
      {"the same triangle twice", {{0, 1, 2}, {1, 2, 0}}},
      {"a corner twice", {{0, 1, 1}}},
      {"points that are none", {{0, 1, 7}, {0, NONE, 2}}}};
  for (const auto& [what, triangles] : cases) {
    TriangleMesh mesh;
    mesh.triangles = triangles;
    EXPECT_FALSE (mesh.connect (7, 1)) << what;
  }
}

TEST (MeshCheck, NeighborsThatDoNotFitAreFoundAndTold)
{
  const Mesh known = beside (sheet (3), tetrahedron ());
  const TriangleMesh sound = connected (known);
  const Points points = pointsAt (known.positions);
  const auto expectBroken = [&] (const TriangleMesh& mesh, std::size_t edges,
                                 std::size_t vertices) {
    const MeshExamination found =
        checkMesh (mesh, points, std::vector<float> (points.size (), 0.1F), 1);
    EXPECT_FALSE (found.isManifold ());
    EXPECT_EQ (found.check.nonmanifold_edges, edges);
    EXPECT_EQ (found.check.nonmanifold_vertices, vertices);
    EXPECT_NE (found.figures.broken.at, NONE);
    Report report;
    const Problem problem = reportMesh (points, mesh.triangles, found, {}, {}, {}, report);
    EXPECT_EQ (problem.status, RunStatus::INTERNAL_ERROR);
    EXPECT_NE (problem.message.find ("not an oriented manifold"), std::string::npos);
    EXPECT_TRUE (report.check.done);
  };
  TriangleMesh mesh = sound;
  const Index last = static_cast<Index> (mesh.triangles.size ()) - 1;
  const Index other = mesh.neighbors[last][0];
  mesh.neighbors[last][0] = NONE; // seen from one side only
  expectBroken (mesh, 1, 0);
  const MeshEdge mate = sound.mate ({last, 0});
  mesh.neighbors[mate.triangle][mate.side] = NONE; // from neither
  ASSERT_EQ (mate.triangle, other);
  expectBroken (mesh, 1, 0);
  mesh = sound;
  mesh.triangles[last][0] = 0; // a corner far away
  expectBroken (mesh, 4, 0);
  mesh = sound;
  mesh.triangle_of[3] = NONE;
  expectBroken (mesh, 0, 1);
}

std::vector<std::string>
warningsOf (const Mesh& mesh, const Options& options = {}, float spacing = 0.1F)
{
  Report report;
  EXPECT_FALSE (reportMesh (pointsAt (mesh.positions), mesh.triangles, check (mesh, spacing), {},
                            {}, options, report));
  describeFindings (report);
  return report.warnings;
}

void
expectWarning (const std::vector<std::string>& warnings, const std::string& begin,
               const std::string& place)
{
  ASSERT_EQ (warnings.size (), 1U) << testing::PrintToString (warnings);
  EXPECT_EQ (warnings.front ().rfind (begin, 0), 0U) << warnings.front ();
  EXPECT_NE (warnings.front ().find (place), std::string::npos) << warnings.front ();
}

TEST (MeshCheck, FoldsLongEdgesAndTrianglesWithoutAreaAreFoundAndTold)
{
  Mesh mesh = sheet (4);
  MeshExamination found = check (mesh);
  EXPECT_EQ (found.check.folds, 0U);
  EXPECT_EQ (found.figures.folds.at, NONE);
  EXPECT_EQ (found.figures.long_edges.count, 0U);
  EXPECT_NEAR (found.check.longest_edge, std::sqrt (2.0), 1e-6);
  expectWarning (warningsOf (mesh, {}, 1e-14F), "", "1.41e+13 spacings");

  // The last column is folded back by 110 degrees, then by 130.
  for (const bool folded : {false, true}) {
    const double angle = (folded ? 130.0 : 110.0) * PI / 180.0;
    for (Index y = 0; y < 5; ++y)
      mesh.positions[5 * y + 4] = {0.3 + 0.1 * std::cos (angle), 0.1 * y, 0.1 * std::sin (angle)};
    found = check (mesh);
    EXPECT_EQ (found.check.folds, folded ? 4U : 0U);
    EXPECT_EQ (found.figures.folds.at, folded ? 3U : NONE);
  }
  expectWarning (warningsOf (mesh), "4 edges are folded", "point 10 (103, -20, 3)");

  // A corner far away, where two boundary edges and a diagonal end.
  mesh = sheet (4);
  mesh.positions[24] = {1.4, 1.4, 0.0};
  found = check (mesh);
  EXPECT_EQ (found.figures.long_edges.count, 1U);
  EXPECT_EQ (found.figures.longest_inside.at, (std::pair<Index, Index>{18, 24}));
  EXPECT_NEAR (std::sqrt (found.figures.longest_inside.sqr_length), 11.0 * std::sqrt (2.0), 1e-5);
  EXPECT_EQ (found.check.longest_edge_at, (std::array<Index, 2>{3 * 18 + 1, 3 * 24 + 1}));
  expectWarning (warningsOf (mesh), "1 edge inside the surface is much longer",
                 "15.6 spacings from point 55 (103, -17, 3) to point 73");

  // Three points on a line, up to ten times the precision of coordinates, or up to a tenth of it.
  for (const bool flat : {false, true}) {
    mesh = {{{0, 0, 0}, {0.5, 0, flat ? 1e-8 : 1e-6}, {1, 0, 0}, {0.5, 1, 0}},
            {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}}};
    found = check (mesh);
    EXPECT_EQ (found.check.degenerate_triangles, flat ? 1U : 0U);
    EXPECT_EQ (found.figures.degenerate.at, flat ? 0U : NONE);
    EXPECT_EQ (found.check.folds, 0U); // at right angles to the others, or none
  }
  expectWarning (warningsOf (mesh, {}, 1.0F), "1 triangle has no area", "point 1 (100, -20, 3)");
  // Small triangles are not degenerate.
  EXPECT_EQ (check (tetrahedron (1e-9), 1e-10F).check.degenerate_triangles, 0U);
}

TEST (CheckReport, WarnsOfPointsWithoutTrianglesAndOfSmallComponents)
{
  for (const Mesh& mesh : {sheet (20), torus (20, 9), annulus (30), beside (sheet (4), sheet (4))})
    EXPECT_EQ (warningsOf (mesh), std::vector<std::string>{});
  Mesh unused = sheet (4);
  unused.positions.emplace_back (0.5, 0.25, 0.0);
  expectWarning (warningsOf (unused), "1 point is in no triangle", "point 76 (105, -17.5, 3)");
  expectWarning (warningsOf (beside (sheet (40), sheet (1))), "the mesh has 2 components",
                 "of 4 points at point 5044 (150");
}

TEST (CheckReport, WarnsOfSmallHolesIfNoOptionAsksForThem)
{
  Mesh holed = sheet (20);
  for (const std::ptrdiff_t t : {610, 250, 100})
    holed.triangles.erase (holed.triangles.begin () + t);
  expectWarning (warningsOf (holed), "3 small holes stay open", "the largest, of 3 points");
  Options options;
  options.holes.policy = HolePolicy::CLOSE_ALL;
  expectWarning (warningsOf (holed, options), "4 holes stay open though", "of 80 points, around");
  for (const HolePolicy policy :
       {HolePolicy::KEEP_COUNT, HolePolicy::BY_SIZE, HolePolicy::KEEP_LARGEST}) {
    options.holes.policy = policy;
    EXPECT_TRUE (warningsOf (holed, options).empty ());
  }
  options = {};
  options.trimming.open_self_intersections = true;
  EXPECT_TRUE (warningsOf (holed, options).empty ());
}

TEST (LoopReport, TellsDoubtfulDecisionsAndWarnsOfHolesTooDeepToBeFilled)
{
  const Points points = pointsAt (sheet (20).positions);
  const auto judged = [] (std::vector<Index> corners, double width, bool is_open,
                          const LoopJudgement& judgement) {
    BoundaryLoop one;
    one.judgement = judgement;
    one.points = std::move (corners);
    one.width = width;
    one.spacing = 0.5;
    one.keep_open = is_open;
    return one;
  };
  Surface surface;
  surface.holes_filled = 7;
  Report report;
  surface.doubtful_loops = {judged ({9, 8, 4, 5}, 4.0, true, {1.5, 0.0, false}),
                            judged ({2, 3, 1}, 1.0, false, {-0.5, 0.0, false})};
  reportLoops (points, surface, report);
  describeFindings (report);
  EXPECT_TRUE (report.warnings.empty ());
  EXPECT_EQ (report.statistics.holes_filled, 7U);
  ASSERT_EQ (report.loop_decisions.size (), 2U);
  const LoopDecision &filled = report.loop_decisions[0], &open = report.loop_decisions[1];
  EXPECT_FALSE (filled.stays_open); // the least sure one is the first
  EXPECT_NEAR (filled.probability, 1.0 / (1.0 + std::exp (0.5)), 1e-12);
  EXPECT_EQ (filled.points, 3U);
  EXPECT_EQ (filled.at, points.cloud_index[1]);
  EXPECT_TRUE (open.stays_open);
  EXPECT_EQ (open.points, 4U);
  EXPECT_EQ (open.width, 4.0 * points.scale);
  EXPECT_EQ (open.width_spacings, 8.0);

  surface.doubtful_loops = {judged ({9, 8, 4, 5}, 4.0, true, {-5.0, 0.0, true}),
                            judged ({30, 31, 32}, 6.0, true, {-5.0, 0.0, true}),
                            judged ({50, 51, 52}, 9.0, false, {-5.0, 0.0, true}),
                            judged ({60, 61, 62}, 9.0, true, {1.0, 0.0, true})};
  reportLoops (points, surface, report);
  describeFindings (report);
  expectWarning (report.warnings, "2 holes stay open though",
                 "(12 local spacings) around point 91");
}

TEST (CheckReport, TheReportHasCloudIndicesAndTheLongestLoop)
{
  Mesh mesh = beside (sheet (3), annulus (30));
  mesh.positions.emplace_back (0, 0, 1);
  mesh.positions.emplace_back (0, 0, 2);
  const MeshExamination found = check (mesh);
  Report report;
  report.outliers = {3 * 166 + 1};
  ASSERT_FALSE (reportMesh (pointsAt (mesh.positions), mesh.triangles, found, {}, {}, {}, report));
  EXPECT_EQ (report.unused, (std::vector<Index>{3 * 167 + 1}));
  EXPECT_EQ (report.statistics.used_points, 166U);
  ASSERT_EQ (report.loop.size (), 30U);
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_EQ (report.loop[i], 3 * found.loops.front ().points[i] + 1);
  EXPECT_EQ (report.statistics.loop_points, 30U);
  EXPECT_EQ (report.check.loops.size (), 3U);
  // A loop that is there already is kept.
  report.loop = {1, 2, 3};
  ASSERT_FALSE (reportMesh (pointsAt (mesh.positions), mesh.triangles, found, {}, {}, {}, report));
  EXPECT_EQ (report.loop, (std::vector<Index>{1, 2, 3}));
}

} // namespace
} // namespace pcl::floater
