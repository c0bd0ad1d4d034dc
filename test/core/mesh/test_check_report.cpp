// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the report says about an examined mesh.
#include "mesh/known_meshes.h"
#include "report/report_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace pcl::floater {
namespace {
using samples::annulus;
using samples::beside;
using samples::check;
using samples::Mesh;
using samples::pointsAt;
using samples::sheet;
using samples::torus;

std::vector<std::string>
warningsOf (const Mesh& mesh, const Options& options = {})
{
  Report report;
  EXPECT_FALSE (reportCheck (pointsAt (mesh.positions), check (mesh), options, report));
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

TEST (CheckReport, WarningsNameThePlace)
{
  for (const Mesh& mesh : {sheet (20), torus (20, 9), annulus (30)})
    EXPECT_EQ (warningsOf (mesh), std::vector<std::string>{});

  Mesh unused = sheet (4);
  unused.positions.emplace_back (0.5, 0.25, 0.0);
  expectWarning (warningsOf (unused), "1 point is in no triangle", "point 76 (105, -17.5, 3)");

  Mesh folded = sheet (4);
  for (Index y = 0; y < 5; ++y)
    folded.positions[5 * y + 4].x () = 0.25;
  expectWarning (warningsOf (folded), "4 edges are folded", "point 10 (103, -20, 3)");

  Mesh with_long_edge = sheet (4);
  with_long_edge.positions[24] = {1.4, 1.4, 0.0};
  expectWarning (warningsOf (with_long_edge), "1 edge inside the surface is much longer",
                 "15.6 spacings from point 55 (103, -17, 3) to point 73");

  expectWarning (warningsOf (beside (sheet (40), sheet (1))), "the mesh has 2 components",
                 "of 4 points at point 5044 (150");
  EXPECT_TRUE (warningsOf (beside (sheet (4), sheet (4))).empty ());

  const Mesh line{{{0, 0, 0}, {0.05, 0, 0}, {0.1, 0, 0}, {0.05, 0.1, 0}},
                  {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}}};
  expectWarning (warningsOf (line), "1 triangle has no area", "point 1 (100, -20, 3)");
}

TEST (CheckReport, TellsOfEdgesAnyNumberOfSpacingsLong)
{
  const Mesh mesh = sheet (4);
  Report report;
  EXPECT_FALSE (reportCheck (pointsAt (mesh.positions), check (mesh, 1e-14F), {}, report));
  ASSERT_EQ (report.warnings.size (), 1U);
  EXPECT_NE (report.warnings.front ().find ("1.41e+13 spacings"), std::string::npos)
      << report.warnings.front ();
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
    JudgedLoop one{{}, judgement};
    one.loop.points = std::move (corners);
    one.loop.width = width;
    one.loop.spacing = 0.5;
    one.loop.keep_open = is_open;
    return one;
  };
  Surface surface;
  surface.holes_filled = 7;
  Report report;
  surface.doubtful_loops = {judged ({9, 8, 4, 5}, 4.0, true, {1.5, 0.0, false}),
                            judged ({2, 3, 1}, 1.0, false, {-0.5, 0.0, false})};
  reportLoops (points, surface, report);
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
  ASSERT_FALSE (reportCheck (pointsAt (mesh.positions), found, {}, report));
  EXPECT_EQ (report.unused, (std::vector<Index>{3 * 167 + 1}));
  EXPECT_EQ (report.statistics.used_points, 166U);
  ASSERT_EQ (report.loop.size (), 30U);
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_EQ (report.loop[i], 3 * found.loops.front ().points[i] + 1);
  EXPECT_EQ (report.statistics.loop_points, 30U);
  EXPECT_EQ (report.check.loops.size (), 3U);
  // A loop that is there already is kept.
  report.loop = {1, 2, 3};
  ASSERT_FALSE (reportCheck (pointsAt (mesh.positions), found, {}, report));
  EXPECT_EQ (report.loop, (std::vector<Index>{1, 2, 3}));
}
} // namespace
} // namespace pcl::floater
