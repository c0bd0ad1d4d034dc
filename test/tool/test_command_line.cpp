// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Options, reports, and outputs that cannot be written.
#include "command_line_test.h"
#include "mesh_files.h"

namespace pcl::floater {
namespace {
TEST_F (CommandLineTest, HelpAndVersion)
{
  for (const std::string option : {"--help", "-h"}) {
    const Outcome help = run ({option});
    EXPECT_EQ (help.code, 0);
    EXPECT_EQ (help.err, "");
    for (const char* part :
         {"INPUT", "OUTPUT", "--topology NAME (auto)", "by-size", "--strict", "--neighbors N (20)",
          "mean-value", "Examples:", "Exit codes:", "  6  with --strict"})
      EXPECT_NE (help.out.find (part), std::string::npos) << part;
  }
  const Outcome version = run ({"--version"});
  EXPECT_EQ (version.code, 0);
  EXPECT_EQ (version.out.rfind ("pcl_floater_reconstruct ", 0), 0U);
}

TEST_F (CommandLineTest, BadOptionsAreRefused)
{
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"-k", "20.5"}, "'20.5' is not a whole number"},
      {{"-k", "99999999999999999999"}, "is not a whole number"},
      {{"--opening-angle", "wide"}, "'wide' is not a number"},
      {{"--opening-angle", "nan"}, "--opening-angle must be above 0 and below 360"},
      {{"--holes", "by-size"}, "--holes by size need"},
      {{"--topology", "disc", "--holes", "close-all"}, "one boundary loop and no holes"},
      {{"--largest-hole-length", "inf"}, "must be 0 or more"},
      {{"--largest-hole-length", "1", "--largest-hole", "2"}, "excludes"},
      {{"--shift", "1,2"}, "'1,2' is neither auto nor three numbers"},
      {{"--shift", "1,2,3,4"}, "'1,2,3,4' is neither"},
      {{"--shift", "1,2,3m"}, "'1,2,3m' is neither"},
      {{"--shift", "1,2,nan"}, "'1,2,nan' is neither"},
      {{"--viewpoint", "1,2"}, "'1,2' is neither auto, none, nor three numbers"},
      {{"--viewpoint", "0,0,1", "--topology", "disc"}, "of no use for a disc"},
      {{"--remove-outliers", "yes"}, "'yes' is none of: on, off"},
      {{"--topology", "surface", "--loop", "loop.txt"}, "are for a disc"},
      {{"--topology", "surface", "--parameterization", "flat.ply"}, "are for a disc"},
      {{"--ordering", "colamd"}, "'colamd' is none of: automatic"},
      {{"--limit", "parts.pints=5000"}, "no NAME=VALUE of a limit"},
      {{"--limit", "parts.points"}, "'' is no value of parts.points"},
      {{"--limit", "parts.points=3"}, "'3' is no value of parts.points"}};
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
  expectFailure ({"in.pcd", "out"}, OUTPUT_FAILED, "it has no extension that tells its format");
  expectFailure ({"in.pcd", "out.ply", "--parameterization", "out.png"}, OUTPUT_FAILED,
                 "'.png' is unknown");
  EXPECT_TRUE (std::filesystem::is_symlink (path ("full.ply")));
  EXPECT_TRUE (std::filesystem::is_character_file ("/dev/full"));
}

/// Paths are checked first: with a bad output, the missing input is not even noticed.
TEST_F (CommandLineTest, OutputIsCheckedBeforeTheWork)
{
  expectFailure ({"missing.pcd", "missing/out.ply"}, OUTPUT_FAILED, "there is no folder");
}

/// As on a full disk: the write fails when a part of the file has been written. No part of any
/// output is left.
TEST_F (CommandLineTest, WriteThatFailsHalfWay)
{
  writeFile ("out.ply", "what was there before");
  for (const std::string name : {"out.vtk", "out.ply", "out.obj", "out.stl", "out.off", "out.glb"})
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
                           "1 component, genus 0, with boundary", "loops      1 of", "seconds",
                           "warnings   0", "mesh       out.vtk"})
    EXPECT_NE (outcome.out.find (part), std::string::npos) << part;
  EXPECT_EQ (outcome.out.find ('{'), std::string::npos);
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
      {"--max-edge", "9", "max_edge", 9.0},
      {"--max-edge-ratio", "9", "max_edge_ratio", 9.0},
      {"--min-component", "9", "min_component", 9},
      {"--remove-outliers", "off", "remove_outliers", false},
      {"--scatter", "drop", "scatter", "drop"},
      {"--denoise", "off", "denoise", false},
      {"--viewpoint", "none", "viewpoint", "none"},
      {"--viewpoint", "0,-1,20.5", "viewpoint", {0.0, -1.0, 20.5}},
      {"--boundary", "consensus", "boundary", "consensus"},
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
      {"--facing", "outwards", "facing", "outwards"},
      {"--facing", "up", "facing", "up"},
      {"--flips", "off", "flips", false},
      {"--uncross", "off", "uncross", false},
      {"--open-crossings", "on", "open_crossings", true},
      {"--threads", "2", "threads", 2},
      {"--blocks", "3", "blocks", 3}};
  for (const auto& [option, value, key, expected] : cases) {
    SCOPED_TRACE (option);
    EXPECT_NE (defaults.at (key), expected);
    // The report is written even if the option makes the run fail on this cloud.
    run ({"in.pcd", "out.ply", "--report", option + ".json", option, value});
    const Json options = Json::parse (readFile (option + ".json")).at ("options");
    EXPECT_EQ (options.at (key), expected);
    Json restored = options;
    restored[key] = defaults.at (key);
    EXPECT_EQ (restored, defaults);
  }
  EXPECT_EQ (report ({"--flips", "off"}).at ("statistics").at ("flips"), 0);
}

TEST_F (CommandLineTest, TheMethodOfTheReport)
{
  const Json made = report ({"--method", "tw385", "--cluster-tolerance", "0.2"});
  const Json& options = made["options"];
  EXPECT_EQ (options["method"], "tw385");
  EXPECT_EQ (options["topology"], "disc");
  EXPECT_EQ (options["boundary"], "two-segments");
  EXPECT_EQ (options["flips"], false);
  // What is given stays.
  const Json other = report ({"--method", "tw385", "--boundary", "spanning-tree"});
  EXPECT_EQ (other["options"]["boundary"], "spanning-tree");
  const Outcome refused = run ({"in.pcd", "out.ply", "--method", "tw385", "--topology", "surface"});
  EXPECT_EQ (refused.code, USAGE);
  EXPECT_NE (refused.err.find ("TW 385"), std::string::npos) << refused.err;
}

TEST_F (CommandLineTest, OptionsThatTheMethodOfTheReportDoesNotTake)
{
  const auto warnings = [this] (std::vector<std::string> options) {
    options.insert (options.end (), {"--method", "tw385", "--cluster-tolerance", "0.2"});
    return report (options).at ("warnings").dump ();
  };
  EXPECT_EQ (warnings ({}).find ("no effect"), std::string::npos);
  EXPECT_EQ (warnings ({"--flips", "off"}).find ("no effect"), std::string::npos);
  EXPECT_NE (warnings ({"--flips", "on"}).find ("an option has no effect: --flips; --method tw385"),
             std::string::npos);
  EXPECT_NE (warnings ({"--denoise", "on", "--scatter", "drop"})
                 .find ("options have no effect: --scatter, --denoise; --method tw385"),
             std::string::npos);
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
} // namespace pcl::floater
