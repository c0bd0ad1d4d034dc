// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The report, the summary as JSON, and warnings that --strict does not allow.
#include "command_line_test.h"
#include "mesh_files.h"

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
using ReportTest = CommandLineTest;

TEST_F (ReportTest, JsonIsTheLastLine)
{
  for (const bool quiet : {false, true}) {
    const Outcome outcome = run ({"in.pcd", "out.ply", "--json", quiet ? "-q" : "--threads=1"});
    ASSERT_EQ (outcome.code, 0);
    const std::string lines = outcome.out.substr (0, outcome.out.size () - 1);
    const std::size_t before = lines.rfind ('\n');
    EXPECT_EQ (before == std::string::npos, quiet);
    const Json summary = Json::parse (lines.substr (before == std::string::npos ? 0 : before + 1));
    EXPECT_EQ (summary.at ("status"), "SUCCESS");
    EXPECT_EQ (summary.at ("points"), sample_.size ());
    EXPECT_EQ (summary.at ("components"), 1);
    EXPECT_EQ (summary.at ("genus"), 0);
    EXPECT_EQ (summary.at ("loops"), 1);
    EXPECT_EQ (summary.at ("outliers"), 0);
    EXPECT_EQ (summary.at ("denoised"), false);
    EXPECT_NE (summary.at ("topology"), "unknown");
    EXPECT_TRUE (summary.at ("topology_reason").is_string ());
    EXPECT_GT (summary.at ("recon_seconds").get<double> (), 0.0);
    EXPECT_EQ (summary.at ("triangles"), readPly (path ("out.ply")).triangles.size ());
  }
  writeFile ("line.pcd", pcdText ({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}));
  const Outcome failed = run ({"line.pcd", "out.ply", "--json"});
  EXPECT_EQ (failed.code, RECONSTRUCTION_FAILED);
  EXPECT_EQ (Json::parse (failed.out).at ("status"), "DEGENERATE");
}

TEST_F (ReportTest, ReportHasEverything)
{
  // A repeated point, and two without finite coordinates: the first one and one in between.
  std::vector<Eigen::Vector3d> points = sample_.points;
  const Eigen::Vector3d nowhere (std::nan (""), 0, 0);
  points.insert (points.begin (), nowhere);
  points.insert (points.begin () + 10, Eigen::Vector3d (0, INFINITY, 0));
  points.push_back (points[5]);
  writeFile ("in.pcd", pcdText (points));
  const Json all = report ({});
  EXPECT_EQ (all.at ("tool"), "pcl_floater_reconstruct");
  EXPECT_EQ (all.at ("status"), "SUCCESS");
  EXPECT_EQ (all.at ("message"), "");
  EXPECT_EQ (all.at ("input").at ("file"), "in.pcd");
  EXPECT_EQ (all.at ("input").at ("points"), points.size ());
  EXPECT_EQ (all.at ("output").at ("vertices"), points.size () - 2);
  EXPECT_EQ (all.at ("non_finite"), (Json{0, 10}));
  EXPECT_EQ (all.at ("duplicates"), (Json{{points.size () - 1, 5}}));
  EXPECT_EQ (all.at ("unused"), Json::array ());
  EXPECT_NE (all.at ("warnings").dump ().find ("2 points without finite coordinates were left out"),
             std::string::npos);
  const Json& statistics = all.at ("statistics");
  EXPECT_EQ (statistics.at ("working_points"), sample_.size ());
  EXPECT_EQ (statistics.at ("used_points"), sample_.size ());
  EXPECT_EQ (statistics.at ("loop_points"), all.at ("loop").size ());
  EXPECT_EQ (statistics.at ("triangles"), all.at ("output").at ("triangles"));
  EXPECT_GT (all.at ("peak_memory_bytes").get<std::size_t> (), 1000000U);
  for (const char* stage :
       {"working set", "neighbors", "stars", "boundary", "weights", "solve", "delaunay", "flips"})
    EXPECT_GE (all.at ("seconds").at (stage).get<double> (), 0.0) << stage;
  EXPECT_GE (all.at ("loop").size (), 30U);

  // The vertices after a point that was left out move up, and so do the indices of triangles.
  const MeshContent mesh = readPly (path ("out.ply"));
  points.erase (points.begin () + 10);
  points.erase (points.begin ());
  EXPECT_EQ (mesh.points, points);
  for (const auto& triangle : mesh.triangles)
    for (const std::size_t corner : triangle) {
      ASSERT_LT (corner, sample_.size ());
      EXPECT_LT ((mesh.points[corner] - mesh.points[triangle[0]]).norm (), 4.0);
    }
}

TEST_F (ReportTest, ReportTellsWhatTheMeshIs)
{
  const Json all = report ({"--topology", "disc"});
  EXPECT_EQ (all.at ("topology"), "disc");
  EXPECT_EQ (all.at ("topology_reason"), "asked for");
  for (const char* list : {"outliers", "loop_decisions", "facing_decisions"})
    EXPECT_EQ (all.at (list), Json::array ()) << list;
  EXPECT_EQ (all.at ("facing_certainty"), 1.0);
  for (const char* figure : {"outlier_points", "holes_filled"})
    EXPECT_EQ (all.at ("statistics").at (figure), 0) << figure;
  EXPECT_LT (all.at ("statistics").at ("noise").get<double> (), 0.1);
  for (const char* stage : {"consensus", "holes", "check"})
    EXPECT_GE (all.at ("seconds").at (stage).get<double> (), 0.0) << stage;
  const Json& check = all.at ("check");
  for (const char* flaw : {"nonmanifold_edges", "nonmanifold_vertices", "orientation_conflicts",
                           "genus", "folds", "degenerate_triangles", "self_intersections"})
    EXPECT_EQ (check.at (flaw), 0) << flaw;
  EXPECT_EQ (check.at ("self_intersections_at"), Json::array ());
  for (const char* figure : {"self_intersections_found", "self_intersection_flips",
                             "self_intersection_moves", "self_intersection_rebuilds"})
    EXPECT_EQ (all.at ("statistics").at (figure), 0) << figure;
  EXPECT_EQ (check.at ("components"), 1);
  EXPECT_EQ (check.at ("euler_characteristic"), 1);
  EXPECT_GT (check.at ("longest_edge").get<double> (), 1.0);
  EXPECT_EQ (check.at ("longest_edge_at").size (), 2U);
  ASSERT_EQ (check.at ("loops").size (), 1U);
  const Json& loop = check.at ("loops").front ();
  EXPECT_EQ (loop.at ("points"), all.at ("loop").size ());
  EXPECT_EQ (loop.at ("at"), *std::min_element (all.at ("loop").begin (), all.at ("loop").end ()));
  EXPECT_GT (loop.at ("width").get<double> (), 10.0); // of a square of side 11
  EXPECT_GT (loop.at ("length").get<double> (), 2.0 * loop.at ("width").get<double> ());
  EXPECT_GT (loop.at ("width_spacings").get<double> (), 5.0);

  // Without a mesh there is nothing to check.
  writeFile ("line.pcd", pcdText ({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}));
  run ({"line.pcd", "out.ply", "--report", "failed.json"});
  EXPECT_EQ (Json::parse (readFile ("failed.json")).at ("check"), Json ());
}

TEST_F (ReportTest, StrictTakesWarningsForAFailure)
{
  writeFile ("out.ply", "what was there before");
  std::vector<Eigen::Vector3d> with_nan = sample_.points;
  with_nan.emplace_back (std::nan (""), 0, 0); // a warning: it is left out of the output
  writeFile ("nan.pcd", pcdText (with_nan));
  std::vector<Eigen::Vector3d> with_island = makeSample (false, 24).points;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      with_island.emplace_back (200.0 + i, j, 0.0);
  writeFile ("island.pcd", pcdText (with_island));
  const std::vector<std::pair<std::string, std::string>> cases{
      {"nan.pcd", "1 point without finite coordinates was left out"},
      {"island.pcd", "36 points are in no triangle, point 576 (200, 0, 0) among them"}};
  for (const auto& [cloud, cause] : cases) {
    SCOPED_TRACE (cloud);
    for (const std::string quiet : {"--quiet", "--threads=0"}) {
      const std::vector<std::string> arguments{cloud,        "out.ply", "--report", "out.json",
                                               "--topology", "disc",    quiet};
      std::vector<std::string> strictly = arguments;
      strictly.emplace_back ("--strict");
      const std::set<std::string> before = names ();
      const Outcome outcome = run (strictly);
      EXPECT_EQ (outcome.code, WARNINGS);
      EXPECT_EQ (outcome.out, "");
      EXPECT_EQ (outcome.err.rfind ("pcl_floater_reconstruct: cannot reconstruct '" + cloud +
                                        "': 1 warning, which --strict does not allow (WARNINGS)",
                                    0),
                 0U)
          << outcome.err;
      EXPECT_NE (outcome.err.find ("warning: " + cause), std::string::npos) << outcome.err;
      EXPECT_EQ (readFile ("out.ply"), "what was there before");
      const Json all = Json::parse (readFile ("out.json"));
      EXPECT_EQ (all.at ("status"), "WARNINGS");
      EXPECT_EQ (all.at ("strict"), true);
      EXPECT_EQ (all.at ("output"), Json ());
      ASSERT_EQ (all.at ("warnings").size (), 1U);
      EXPECT_EQ (all.at ("warnings").front ().get<std::string> ().rfind (cause, 0), 0U);
      EXPECT_EQ (all.at ("check").at ("components"), 1);
      std::filesystem::remove (path ("out.json"));
      EXPECT_EQ (names (), before);
    }
    EXPECT_EQ (run ({cloud, "lax.ply", "--topology", "disc", "-q"}).code, 0);
  }
  const Outcome summary =
      run ({"island.pcd", "out.ply", "--topology", "disc", "--strict", "--json"});
  EXPECT_EQ (Json::parse (summary.out).at ("status"), "WARNINGS");
  EXPECT_EQ (Json::parse (summary.out).at ("output"), Json ());

  // A run without warnings writes its mesh; a run that fails anyway fails as without --strict.
  EXPECT_EQ (run ({"in.pcd", "good.ply", "--strict", "-q"}).code, 0);
  EXPECT_EQ (readPly (path ("good.ply")).points, sample_.points);
  writeFile ("line.pcd", pcdText ({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}));
  expectFailure ({"line.pcd", "out.ply", "--strict"}, RECONSTRUCTION_FAILED, "(DEGENERATE)");
}

// A shallow bowl is half a body or a valley.
TEST_F (ReportTest, TellsWhichSideMayNotBeTheFront)
{
  constexpr double GOLDEN_ANGLE = 2.399963229728653, SHARE = 0.3; // of the sphere
  constexpr int COUNT = 2000;
  std::vector<Eigen::Vector3d> bowl;
  for (int i = 0; i < COUNT; ++i) {
    const double depth = 1.0 - 2.0 * SHARE * (i + 0.5) / COUNT;
    const double radius = std::sqrt (1.0 - depth * depth), angle = GOLDEN_ANGLE * i;
    bowl.emplace_back (radius * std::cos (angle), radius * std::sin (angle), -depth);
  }
  writeFile ("bowl.pcd", pcdText (bowl));
  const Outcome outcome = run ({"bowl.pcd", "out.ply", "--report", "out.json"});
  ASSERT_EQ (outcome.code, 0) << outcome.err;
  EXPECT_NE (outcome.out.find ("not sure   which side is the front of 1 part\n"), std::string::npos)
      << outcome.out;
  const Json all = Json::parse (readFile ("out.json"));
  ASSERT_EQ (all.at ("facing_decisions").size (), 1U);
  const Json& decision = all.at ("facing_decisions").front ();
  EXPECT_EQ (decision.at ("rule"), "body");
  EXPECT_EQ (decision.at ("certainty"), all.at ("facing_certainty"));
  EXPECT_EQ (decision.at ("triangles"), all.at ("statistics").at ("triangles"));
  EXPECT_LT (all.at ("facing_certainty").get<double> (), 0.9);
}

} // namespace
} // namespace pcl::floater
