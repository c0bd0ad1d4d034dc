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
      {{"--boundary", "none"}, "'none' is none of: spanning-tree"},
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
  ASSERT_EQ (run ({"in.pcd", "fits.ply", "-q"}).code, 0);
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
  for (const char* part :
       {"points     144", "triangles", "loop", "seconds", "warnings   0", "mesh       out.vtk"})
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

TEST_F (CommandLineTest, OptionsReachTheRunAndTheReport)
{
  const Json defaults = report ({}).at ("options");
  const std::vector<std::tuple<std::string, std::string, std::string, Json>> cases{
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
