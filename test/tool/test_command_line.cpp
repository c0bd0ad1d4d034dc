// SPDX-License-Identifier: GPL-3.0-or-later
// Options, reports, and outputs that cannot be written.
#include "mesh_files.h"
#include "sample.h"
#include "tool_runner.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
using Json = nlohmann::json;

constexpr int USAGE = 1;
constexpr int INPUT_FAILED = 2;
constexpr int RECONSTRUCTION_FAILED = 3;
constexpr int OUTPUT_FAILED = 4;
constexpr int WARNINGS = 6;

class CommandLineTest : public ToolTest
{
protected:
  CommandLineTest () : sample_ (makeSample (false))
  {
    writeFile ("in.pcd", pcdText (sample_.points));
  }

  Json report (std::vector<std::string> options) const
  {
    options.insert (options.begin (), {"in.pcd", "out.ply", "--report", "out.json"});
    const Outcome outcome = run (options);
    EXPECT_EQ (outcome.code, 0) << outcome.err;
    return Json::parse (readFile ("out.json"));
  }

  Sample sample_;
};

TEST_F (CommandLineTest, HelpAndVersion)
{
  for (const std::string option : {"--help", "-h"}) {
    const Outcome help = run ({option});
    EXPECT_EQ (help.code, 0);
    EXPECT_EQ (help.err, "");
    for (const char* part :
         {"INPUT", "OUTPUT", "--neighbors N (20)", "mean-value", "Examples:", "Exit codes:"})
      EXPECT_NE (help.out.find (part), std::string::npos) << part;
  }
  const Outcome version = run ({"--version"});
  EXPECT_EQ (version.code, 0);
  EXPECT_EQ (version.out.rfind ("pcl_floater_reconstruct ", 0), 0U);
}

TEST_F (CommandLineTest, BadOptionsAreRefused)
{
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--frobnicate"}, "--frobnicate"},
      {{"-k", "20x"}, "'20x' is not a whole number"},
      {{"-k", "20.5"}, "'20.5' is not a whole number"},
      {{"-k", "99999999999999999999"}, "is not a whole number"},
      {{"-k", "5"}, "from 6 to 200"},
      {{"-k", ""}, "'' is not a whole number"},
      {{"-k"}, "--neighbors"},
      {{"--threads", "-1"}, "threads must be 0"},
      {{"--opening-angle", "wide"}, "'wide' is not a number"},
      {{"--opening-angle", "nan"}, "opening angle must be"},
      {{"--cluster-tolerance", "0"}, "cluster tolerance must be"},
      {{"--cluster-neighbors", "0"}, "must be 1 or more"},
      {{"--sides", "2"}, "3 or more"},
      {{"--domain", "disc"}, "'disc' is none of: circle, square, polygon"},
      {{"--boundary", "none"}, "'none' is none of: spanning-tree, complex"},
      {{"--topology", "sphere"}, "'sphere' is none of: auto, disc, surface"},
      {{"--holes", "all"}, "'all' is none of: auto, close-all, keep-largest"},
      {{"--holes", "by-size"}, "need the largest hole"},
      {{"--topology", "disc", "--holes", "close-all"}, "one boundary loop and no holes"},
      {{"--kept-loops", "-1"}, "kept loops must be 0 or more"},
      {{"--kept-loops", "two"}, "'two' is not a whole number"},
      {{"--largest-hole", "-1"}, "largest hole must be 0 or more"},
      {{"--largest-hole", "wide"}, "'wide' is not a number"},
      {{"--largest-hole", "nan"}, "largest hole must be 0 or more"},
      {{"--largest-hole-length", "-1"}, "length of the largest hole must be 0 or more"},
      {{"--largest-hole-length", "inf"}, "length of the largest hole must be 0 or more"},
      {{"--remove-outliers", "yes"}, "'yes' is none of: on, off"},
      {{"--denoise", "1"}, "'1' is none of: on, off"},
      {{"--strict=maybe"}, "maybe"},
      {{"--topology", "surface", "--loop", "loop.txt"}, "are for a disc"},
      {{"--topology", "surface", "--parameterization", "flat.ply"}, "are for a disc"},
      {{"--weights", "0"}, "'0' is none of: uniform"},
      {{"--ordering", "AMD"}, "'AMD' is none of: automatic"},
      {{"--ordering", "colamd"}, "cannot take the ordering COLAMD"},
      {{"--neighborhood", "all"}, "'all' is none of: nearest-delaunay"},
      {{"--ball-radius", "0"}, "from 1 to 10"},
      {{"--spacing", "even"}, "'even' is none of: chord-length"},
      {{"--solver", "gauss"}, "'gauss' is none of: umfpack"},
      {{"--tolerance", "0"}, "above 0 and below 1"},
      {{"--max-iterations", "0"}, "1 or more"},
      {{"--ilut-fill", "0"}, "from 1 to"},
      {{"--ilut-drop", "2"}, "from 0 to 1"},
      {{"--flips", "maybe"}, "'maybe' is none of: on, off"},
      {{"--sheet-filter", "maybe"}, "'maybe' is none of: on, off"},
      {{"third.ply"}, "third.ply"}};
  for (const auto& [options, cause] : cases) {
    SCOPED_TRACE (cause);
    std::vector<std::string> arguments{"in.pcd", "out.ply"};
    arguments.insert (arguments.end (), options.begin (), options.end ());
    expectFailure (arguments, USAGE, cause);
  }
  expectFailure ({}, USAGE, "INPUT is required");
  expectFailure ({"in.pcd"}, USAGE, "OUTPUT is required");
}

TEST_F (CommandLineTest, SameFileTwice)
{
  ASSERT_EQ (run ({"in.pcd", "cloud.ply", "-q"}).code, 0);
  const std::string before = readFile ("cloud.ply");
  std::filesystem::create_symlink ("cloud.ply", path ("link.ply"));
  for (const std::string output : {"cloud.ply", "./cloud.ply", "link.ply"})
    expectFailure ({"cloud.ply", output}, USAGE, "INPUT and OUTPUT are the same file");
  expectFailure ({"in.pcd", "a.ply", "--report", "./a.ply"}, USAGE,
                 "OUTPUT and --report are the same file");
  expectFailure ({"in.pcd", "a.ply", "--parameterization", "a.ply"}, USAGE, "are the same file");
  expectFailure ({"in.pcd", "a.ply", "--report", "in.pcd"}, USAGE,
                 "INPUT and --report are the same file");
  EXPECT_EQ (readFile ("cloud.ply"), before);
}

TEST_F (CommandLineTest, OutputsThatCannotBeWritten)
{
  std::filesystem::create_directory (path ("folder.ply"));
  std::filesystem::create_symlink ("/dev/full", path ("full.ply"));
  const std::vector<std::pair<std::string, std::string>> outputs{
      {"missing/out.ply", "there is no folder '"},
      {"in.pcd/out.ply", "is not a folder"},
      {"folder.ply", "it is a folder"},
      {"full.ply", "it is a device"}};
  for (const auto& [output, cause] : outputs) {
    SCOPED_TRACE (output);
    expectFailure ({"in.pcd", output}, OUTPUT_FAILED, "cannot write '" + output + "'");
    expectFailure ({"in.pcd", output}, OUTPUT_FAILED, cause);
    expectFailure ({"in.pcd", "out.ply", "--report", output}, OUTPUT_FAILED, cause);
    expectFailure ({"in.pcd", "out.ply", "--parameterization", output}, OUTPUT_FAILED, cause);
  }
  expectFailure ({"in.pcd", "out.xyz"}, OUTPUT_FAILED, "its extension '.xyz' is unknown");
  expectFailure ({"in.pcd", "out"}, OUTPUT_FAILED, "its extension '' is unknown");
  expectFailure ({"in.pcd", "out.ply", "--parameterization", "out.png"}, OUTPUT_FAILED,
                 "'.png' is unknown");
  EXPECT_TRUE (std::filesystem::is_symlink (path ("full.ply")));
  EXPECT_TRUE (std::filesystem::is_character_file ("/dev/full"));
}

/// Paths are looked at first: with a bad output not even the missing input is noticed.
TEST_F (CommandLineTest, OutputIsCheckedBeforeTheWork)
{
  expectFailure ({"missing.pcd", "missing/out.ply"}, OUTPUT_FAILED, "there is no folder");
}

/// As on a full disk: the write fails when part of the file is there. Nothing is left of any
/// output.
TEST_F (CommandLineTest, WriteThatFailsHalfWay)
{
  writeFile ("out.ply", "what was there before");
  for (const std::string name : {"out.vtk", "out.ply", "out.obj", "out.stl"})
    expectFailure ({"in.pcd", name, "--report", "out.json"}, OUTPUT_FAILED,
                   "cannot write '" + name + "': File too large", 1000);
  // The mesh fits, the flat mesh in double precision does not: neither appears.
  ASSERT_EQ (run ({"in.pcd", "fits.ply", "-q", "--topology", "disc"}).code, 0);
  const std::size_t limit = std::filesystem::file_size (path ("fits.ply")) + 100;
  expectFailure ({"in.pcd", "out.ply", "--parameterization", "flat.ply"}, OUTPUT_FAILED,
                 "cannot write 'flat.ply'", limit);
  EXPECT_EQ (readFile ("out.ply"), "what was there before");
}

TEST_F (CommandLineTest, OutputIsReplacedAndKeepsLinkAndPermissions)
{
  writeFile ("target.ply", "old");
  using std::filesystem::perms;
  std::filesystem::permissions (path ("target.ply"), perms::owner_read | perms::owner_write);
  std::filesystem::create_symlink ("target.ply", path ("out.ply"));
  ASSERT_EQ (run ({"in.pcd", "out.ply", "-q"}).code, 0);
  EXPECT_TRUE (std::filesystem::is_symlink (path ("out.ply")));
  EXPECT_EQ (readPly (path ("target.ply")).points, sample_.points);
  EXPECT_EQ (std::filesystem::status (path ("target.ply")).permissions (),
             perms::owner_read | perms::owner_write);
}

TEST_F (CommandLineTest, QuietPrintsNothing)
{
  const Outcome outcome = run ({"--quiet", "in.pcd", "out.vtk"});
  EXPECT_EQ (outcome.code, 0);
  EXPECT_EQ (outcome.out + outcome.err, "");
  EXPECT_EQ (names (), (std::set<std::string>{"in.pcd", "out.vtk"}));
}

TEST_F (CommandLineTest, SummaryNamesFiguresAndFile)
{
  const Outcome outcome = run ({"in.pcd", "out.vtk"});
  EXPECT_EQ (outcome.code, 0);
  for (const char* part : {"points     144", "0 outliers", "triangles", "topology   ",
                           "1 piece, genus 0, with boundary", "loops      1 of", "seconds",
                           "warnings   0", "mesh       out.vtk"})
    EXPECT_NE (outcome.out.find (part), std::string::npos) << part;
  EXPECT_EQ (outcome.out.find ('{'), std::string::npos);
}

TEST_F (CommandLineTest, JsonIsTheLastLine)
{
  for (const bool quiet : {false, true}) {
    const Outcome outcome = run ({"in.pcd", "out.ply", "--json", quiet ? "-q" : "--threads=1"});
    ASSERT_EQ (outcome.code, 0);
    const std::string lines = outcome.out.substr (0, outcome.out.size () - 1);
    const std::size_t before = lines.rfind ('\n');
    EXPECT_EQ (before == std::string::npos, quiet);
    const Json summary = Json::parse (lines.substr (before == std::string::npos ? 0 : before + 1));
    EXPECT_EQ (summary.at ("status"), "OK");
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

TEST_F (CommandLineTest, ReportHasEverything)
{
  // A repeated point, two without finite coordinates, at the begin and in between.
  std::vector<Eigen::Vector3d> points = sample_.points;
  const Eigen::Vector3d nowhere (std::nan (""), 0, 0);
  points.insert (points.begin (), nowhere);
  points.insert (points.begin () + 10, Eigen::Vector3d (0, INFINITY, 0));
  points.push_back (points[5]);
  writeFile ("in.pcd", pcdText (points));
  const Json all = report ({});
  EXPECT_EQ (all.at ("tool"), "pcl_floater_reconstruct");
  EXPECT_EQ (all.at ("status"), "OK");
  EXPECT_EQ (all.at ("message"), "");
  EXPECT_EQ (all.at ("input").at ("file"), "in.pcd");
  EXPECT_EQ (all.at ("input").at ("points"), points.size ());
  EXPECT_EQ (all.at ("output").at ("vertices"), points.size () - 2);
  EXPECT_EQ (all.at ("non_finite"), (Json{0, 10}));
  EXPECT_EQ (all.at ("duplicates"), (Json{{points.size () - 1, 5}}));
  EXPECT_EQ (all.at ("unused"), Json::array ());
  EXPECT_NE (all.at ("warnings").dump ().find ("2 points without finite coordinates"),
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

  // The vertices after a point that was left out move up, with their triangles.
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

TEST_F (CommandLineTest, ReportTellsWhatTheMeshIs)
{
  const Json all = report ({"--topology", "disc"});
  EXPECT_EQ (all.at ("topology"), "disc");
  EXPECT_EQ (all.at ("topology_reason"), "asked for");
  EXPECT_EQ (all.at ("strict"), false);
  EXPECT_EQ (all.at ("denoised"), false);
  EXPECT_EQ (all.at ("outliers"), Json::array ());
  for (const char* figure : {"outlier_points", "noise", "holes_filled"})
    EXPECT_EQ (all.at ("statistics").at (figure), 0) << figure;
  for (const char* stage : {"complex", "holes", "check"})
    EXPECT_GE (all.at ("seconds").at (stage).get<double> (), 0.0) << stage;
  const Json& check = all.at ("check");
  for (const char* flaw : {"nonmanifold_edges", "nonmanifold_vertices", "orientation_conflicts",
                           "genus", "folds", "degenerate_triangles"})
    EXPECT_EQ (check.at (flaw), 0) << flaw;
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

TEST_F (CommandLineTest, ALoopOrAMeshInThePlaneMakesADisc)
{
  const Json flat = report ({"--parameterization", "flat.ply"});
  EXPECT_EQ (flat.at ("topology"), "disc");
  EXPECT_EQ (flat.at ("options").at ("topology"), "disc");
  std::string indices;
  for (const Json& index : flat.at ("loop"))
    indices += index.dump () + '\n';
  writeFile ("loop.txt", indices);
  EXPECT_EQ (report ({"--loop", "loop.txt"}).at ("topology"), "disc");
  expectFailure ({"in.pcd", "out.ply", "--loop", "loop.txt", "--holes", "close-all"}, USAGE,
                 "one boundary loop and no holes");
}

TEST_F (CommandLineTest, StrictTakesWarningsForAFailure)
{
  writeFile ("out.ply", "what was there before");
  std::vector<Eigen::Vector3d> with_nan = sample_.points;
  with_nan.emplace_back (std::nan (""), 0, 0); // its absence in the output is a warning
  writeFile ("nan.pcd", pcdText (with_nan));
  std::vector<Eigen::Vector3d> with_island = makeSample (false, 24).points;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      with_island.emplace_back (200.0 + i, j, 0.0);
  writeFile ("island.pcd", pcdText (with_island));
  const std::vector<std::pair<std::string, std::string>> cases{
      {"nan.pcd", "1 points without finite coordinates"},
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

  // What is without warnings is written; what fails anyway fails as ever.
  EXPECT_EQ (run ({"in.pcd", "good.ply", "--strict", "-q"}).code, 0);
  EXPECT_EQ (readPly (path ("good.ply")).points, sample_.points);
  writeFile ("line.pcd", pcdText ({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}));
  expectFailure ({"line.pcd", "out.ply", "--strict"}, RECONSTRUCTION_FAILED, "(DEGENERATE)");
}

TEST_F (CommandLineTest, OptionsReachTheRunAndTheReport)
{
  const Json defaults = report ({}).at ("options");
  const std::vector<std::tuple<std::string, std::string, std::string, Json>> cases{
      {"--topology", "surface", "topology", "surface"},
      {"--topology", "disc", "topology", "disc"},
      {"--holes", "close-all", "holes", "close-all"},
      {"--holes", "keep-largest", "holes", "keep-largest"},
      {"--holes", "keep-count", "holes", "keep-count"},
      {"--kept-loops", "0", "kept_loops", 0},
      {"--largest-hole", "5.5", "largest_hole", 5.5},
      {"--largest-hole-length", "0.25", "largest_hole_length", 0.25},
      {"--remove-outliers", "off", "remove_outliers", false},
      {"--denoise", "off", "denoise", false},
      {"--boundary", "complex", "boundary", "complex"},
      {"--neighbors", "24", "neighbors", 24},
      {"--neighborhood", "ball", "neighborhood", "ball"},
      {"--ball-radius", "3", "ball_radius", 3.0},
      {"--sheet-filter", "off", "sheet_filter", false},
      {"--boundary", "two-segments", "boundary", "two-segments"},
      {"--opening-angle", "150.5", "opening_angle", 150.5},
      {"--cluster-tolerance", "0.2", "cluster_tolerance", 0.2},
      {"--cluster-neighbors", "12", "cluster_neighbors", 12},
      {"--domain", "polygon", "domain", "polygon"},
      {"--sides", "5", "sides", 5},
      {"--spacing", "centripetal", "spacing", "centripetal"},
      {"--weights", "uniform", "weights", "uniform"},
      {"--solver", "bicgstab-ilut", "solver", "bicgstab-ilut"},
      {"--tolerance", "1e-10", "tolerance", 1e-10},
      {"--max-iterations", "100", "max_iterations", 100},
      {"--ilut-fill", "20", "ilut_fill", 20},
      {"--ilut-drop", "0.001", "ilut_drop", 0.001},
      {"--ordering", "metis", "ordering", "metis"},
      {"--flips", "off", "flips", false},
      {"--threads", "2", "threads", 2}};
  for (const auto& [option, value, key, expected] : cases) {
    SCOPED_TRACE (option);
    EXPECT_NE (defaults.at (key), expected);
    // The report is written also if an option does not suit the cloud.
    run ({"in.pcd", "out.ply", "--report", option + ".json", option, value});
    const Json options = Json::parse (readFile (option + ".json")).at ("options");
    EXPECT_EQ (options.at (key), expected);
    Json restored = options;
    restored[key] = defaults.at (key);
    EXPECT_EQ (restored, defaults);
  }
  EXPECT_EQ (report ({"--flips", "off"}).at ("statistics").at ("flips"), 0);
}

TEST_F (CommandLineTest, LoopFromFile)
{
  const Json loop = report ({}).at ("loop");
  std::string text = "# the loop\n";
  for (const Json& index : loop)
    text += index.dump () + (text.size () % 2 == 0 ? ", " : "\n");
  writeFile ("loop.txt", text);
  const Json again = report ({"--loop", "loop.txt"});
  EXPECT_EQ (again.at ("loop"), loop);
  EXPECT_EQ (again.at ("options").at ("loop_given"), true);

  const std::vector<std::string> arguments{"in.pcd", "other.ply", "--loop", "bad.txt"};
  expectFailure (arguments, INPUT_FAILED, "cannot read 'bad.txt': there is no such file");
  writeFile ("bad.txt", "1 2\n3 -4\n");
  expectFailure (arguments, INPUT_FAILED, "line 2: '-4' is not the index of a point");
  writeFile ("bad.txt", "# nothing\n");
  expectFailure (arguments, INPUT_FAILED, "no indices");
  writeFile ("bad.txt", "1 2 3 1000000\n");
  expectFailure (arguments, RECONSTRUCTION_FAILED, "(INVALID_LOOP)");
}

TEST_F (CommandLineTest, ThreadsDoNotChangeTheOutput)
{
  writeFile ("in.pcd", pcdText (makeSample (false, 60).points));
  for (const std::string threads : {"1", "2", "0"})
    ASSERT_EQ (run ({"in.pcd", threads + ".vtk", "-q", "-j", threads, "--parameterization",
                     threads + ".ply"})
                   .code,
               0);
  EXPECT_EQ (readFile ("1.vtk"), readFile ("2.vtk"));
  EXPECT_EQ (readFile ("1.ply"), readFile ("2.ply"));
  EXPECT_EQ (readFile ("1.vtk"), readFile ("0.vtk"));
}

TEST_F (CommandLineTest, NamesWithSpacesAndBytesThatAreNotUtf8)
{
  const std::string name = "my cloud \xe4";
  writeFile (name + ".pcd", pcdText (sample_.points));
  const Outcome outcome =
      run ({name + ".pcd", name + ".ply", "--report", name + ".json", "--json"});
  EXPECT_EQ (outcome.code, 0) << outcome.err;
  EXPECT_EQ (readPly (path (name + ".ply")).points, sample_.points);
  EXPECT_TRUE (Json::accept (readFile (name + ".json")));
}

TEST_F (CommandLineTest, ExtensionsInUpperCase)
{
  std::filesystem::rename (path ("in.pcd"), path ("IN.PCD"));
  EXPECT_EQ (run ({"IN.PCD", "OUT.VTK"}).code, 0);
  EXPECT_EQ (readVtk (path ("OUT.VTK")).points, sample_.points);
}

} // namespace
} // namespace floater
} // namespace pcl
