// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Options are understood or refused, and reach the run. The report, the summary as JSON, and
// warnings that --strict does not allow.
#include "cloud_reader.h"
#include "suggestion.h"
#include "tool_runner.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl::floater {
namespace {
TEST (Suggestions, DistancesCountInsertedDroppedReplacedAndSwappedLetters)
{
  EXPECT_EQ (editDistance ("", "abc"), 3U);
  EXPECT_EQ (editDistance ("Threads", "tHREADS"), 0U);
  EXPECT_EQ (editDistance ("threds", "threads"), 1U);
  EXPECT_EQ (editDistance ("thraeds", "threads"), 1U);
  EXPECT_EQ (editDistance ("kitten", "sitting"), 3U);
}

TEST (Suggestions, OnlyWordsThatAreNear)
{
  const std::vector<std::string> words{"--threads", "--neighbors", "--neighborhood", "-j", "-k"};
  EXPECT_THAT (nearestWords ("--thread", words), ElementsAre ("--threads"));
  EXPECT_THAT (nearestWords ("-threads", words), ElementsAre ("--threads"));
  EXPECT_THAT (nearestWords ("--neighbours", words), ElementsAre ("--neighbors"));
  EXPECT_THAT (nearestWords ("--neigh", words), ElementsAre ("--neighbors", "--neighborhood"));
  EXPECT_THAT (nearestWords ("--k", words), ElementsAre ("-k"));
  for (const std::string word : {"--frobnicate", "--x", "--", "-", "", "--abcdefgh"})
    EXPECT_THAT (nearestWords (word, words), IsEmpty ()) << word;
  EXPECT_THAT (nearestWords (std::string (100000, 'x'), words), IsEmpty ());
  EXPECT_EQ (didYouMean ("--neigh", words), "; did you mean --neighbors or --neighborhood?");
  EXPECT_EQ (didYouMean ("--frobnicate", words), "");
}

TEST_F (CommandLineTest, HelpAndVersion)
{
  for (const std::string option : {"--help", "-h"}) {
    const Outcome help = succeed ({option});
    EXPECT_EQ (help.err, "");
    for (const char* part :
         {"INPUT", "OUTPUT", "--topology NAME (auto)", "by-size", "--strict", "--neighbors N (20)",
          "mean-value", "Examples:", "Exit codes:", "  6  with --strict"})
      EXPECT_THAT (help.out, HasSubstr (part));
  }
  EXPECT_THAT (succeed ({"--version"}).out, StartsWith ("pcl_floater_reconstruct "));
}

struct Mistake
{
  std::string options, message;
};

// INPUT and OUTPUT, and options that are separated by spaces.
std::vector<std::string>
withOptions (const std::string& options)
{
  std::vector<std::string> arguments{"in.pcd", "out.ply"};
  std::istringstream words (options);
  for (std::string word; words >> word;)
    arguments.push_back (word);
  return arguments;
}

TEST_F (CommandLineTest, MessagesNameWhatWasTyped)
{
  const std::vector<Mistake> mistakes{
      {"--thread 4", "there is no option --thread; did you mean --threads?"},
      {"--facing outward", "--facing: 'outward' is none of: auto, outwards, up, viewpoint, "
                           "normals; did you mean outwards?"},
      {"-k 20x", "-k: '20x' is not a whole number"},
      {"--neighbors 20x", "--neighbors: '20x' is not a whole number"},
      {"-k 5", "-k must be from 6 to 200"},
      {"-k", "-k needs a value, N"},
      {"-k 20 --neighbors 30", "--neighbors is given 2 times; give it once"},
      {"--strict=maybe", "--strict takes no value, but has 'maybe'"},
      {"third.ply", "'third.ply' is one file too many: there are one INPUT and one OUTPUT"},
      {"--shift centre",
       "--shift: 'centre' is neither auto nor three numbers, such as 500000,5500000,0"},
      {"--max-memory lots", "--max-memory: 'lots' is not a size, such as 500M or 2G"}};
  for (const auto& [options, message] : mistakes) {
    const Outcome outcome = run (withOptions (options));
    EXPECT_EQ (outcome.code, USAGE);
    EXPECT_EQ (outcome.err, "pcl_floater_reconstruct: " + message + "\nTry --help.\n");
  }
  // An option that is mistyped is told before what else is missing.
  expectFailure ({"--hlep"}, USAGE, "there is no option --hlep; did you mean --help?");
  expectFailure ({"in.pcd"}, USAGE,
                 "OUTPUT is required; the simplest command is pcl_floater_reconstruct scan.pcd "
                 "mesh.ply\nTry --help.\n");
  expectFailure ({}, USAGE, "INPUT is required");
}

TEST_F (CommandLineTest, BadOptionsAreRefused)
{
  const std::vector<Mistake> mistakes{
      {"-k 20.5", "'20.5' is not a whole number"},
      {"-k 99999999999999999999", "is not a whole number"},
      {"--opening-angle wide", "'wide' is not a number"},
      {"--holes by-size", "--holes by size need"},
      {"--largest-hole-length 1 --largest-hole 2", "excludes"},
      {"--shift 1,2", "'1,2' is neither auto nor three numbers"},
      {"--shift 1,2,3m", "'1,2,3m' is neither"},
      {"--shift 1,2,nan", "'1,2,nan' is neither"},
      {"--viewpoint 1,2", "'1,2' is neither auto, none, nor three numbers"},
      {"--facing viewpoint --viewpoint none", "no viewpoint is looked for"},
      {"--facing normals", "--facing normals: the points of 'in.pcd' have no normals"},
      {"--use-input-normals on", "--use-input-normals on: the points of 'in.pcd' have no normals"},
      {"--remove-outliers yes", "'yes' is none of: on, off"},
      {"--topology surface --loop loop.txt", "are for a disc"},
      {"--topology surface --parameterization flat.ply", "are for a disc"},
      {"--loop loop.txt --holes close-all", "one boundary loop and no holes"},
      {"--method tw385 --topology surface", "TW 385"},
      {"--precision half", "--precision: 'half' is none of"},
      {"--limit page.triangle=5000", "no NAME=VALUE of a limit"},
      {"--limit page.triangles", "'' is no value of page.triangles"},
      {"--limit page.triangles=3", "'3' is no value of page.triangles"},
      {"--max-memory 1M", "'1M' is too small; it must be "},
      {"--scratch .", "--scratch is of no use without --max-memory"},
      {"--max-memory 2G --topology disc", "of a disc"},
      {"--max-memory 2G --parameterization flat.ply", "of a disc"},
      {"--max-memory 2G --uv", "--max-memory"},
      {"--max-memory 2G --html page.html", "--max-memory"},
      {"--texture c.jpg", "no PNG file"},
      {"--texture-size 512", "without --texture"},
      {"--texture c.png --texture-size 7", "--texture-size"},
      {"--texture c.png", "have no colours"},
      {"--report -", "--report takes the name of a file, not -"},
      {"--html -", "--html takes the name of a file, not -"},
      {"--loop -", "--loop takes the name of a file, not -"},
      {"--parameterization -", "--parameterization takes the name of a file, not -"}};
  for (const auto& [options, cause] : mistakes)
    expectFailure (withOptions (options), USAGE, cause);
}

TEST_F (CommandLineTest, SameFileTwice)
{
  succeed ({"in.pcd", "cloud.ply", "-q"});
  const std::string before = readFile ("cloud.ply");
  std::filesystem::create_symlink ("cloud.ply", path ("link.ply"));
  for (const std::string output : {"cloud.ply", "./cloud.ply", "link.ply"})
    expectFailure ({"cloud.ply", output}, USAGE, "INPUT and OUTPUT are the same file");
  expectFailure ({"in.pcd", "a.ply", "--report", "./a.ply"}, USAGE,
                 "OUTPUT and --report are the same file");
  expectFailure ({"in.pcd", "a.ply", "--html", "./a.ply"}, USAGE,
                 "OUTPUT and --html are the same file");
  expectFailure ({"in.pcd", "a.ply", "--report", "a", "--html", "a"}, USAGE, "are the same file");
  expectFailure ({"in.pcd", "a.ply", "--parameterization", "a.ply"}, USAGE, "are the same file");
  expectFailure ({"in.pcd", "a.ply", "--report", "in.pcd"}, USAGE,
                 "INPUT and --report are the same file");
  expectFailure ({"--uv", "--report", "a.mtl", "in.pcd", "a.obj"}, USAGE, "are the same file");
  EXPECT_EQ (readFile ("cloud.ply"), before);
}

TEST_F (CommandLineTest, OptionsReachTheRunAndTheReport)
{
  const Json defaults = report ({}).at ("options");
  std::istringstream all (
      "topology disc  holes close-all  kept-loops 0  largest-hole 5.5 "
      "largest-hole-length 0.25  max-edge 9  max-edge-ratio 9  min-component 9 "
      "remove-outliers off  scatter drop  denoise off  viewpoint none  viewpoint 0,-1,20.5 "
      "neighbors 24  neighborhood ball  ball-radius 3  sheet-filter off "
      "boundary two-segments  opening-angle 150.5  cluster-tolerance 0.2 "
      "cluster-neighbors 12  domain polygon  sides 5  spacing centripetal  weights uniform "
      "solver bicgstab-ilut  tolerance 1e-10  max-iterations 100  ilut-fill 20 "
      "ilut-drop 0.001  ordering metis  facing outwards  facing up  flips off  uncross off "
      "open-crossings on  threads 2  blocks 3");
  for (std::string option, value; all >> option >> value;) {
    SCOPED_TRACE (option + " " + value);
    std::string key = option;
    std::replace (key.begin (), key.end (), '-', '_');
    Json expected = Json::parse (value.find (',') == std::string::npos ? value : "[" + value + "]",
                                 nullptr, false);
    if (expected.is_discarded ()) // a word
      expected = value == "on" ? Json (true) : value == "off" ? Json (false) : Json (value);
    EXPECT_NE (defaults.at (key), expected);
    // The report is written even if the option makes the run fail on this cloud.
    std::filesystem::remove (path ("out.json"));
    run ({"in.pcd", "out.ply", "--report", "out.json", "--" + option, value});
    Json options = Json::parse (readFile ("out.json")).at ("options");
    EXPECT_EQ (options.at (key), expected);
    options[key] = defaults.at (key);
    EXPECT_EQ (options, defaults);
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
  EXPECT_EQ (again.at ("topology"), "disc"); // as with a mesh in the plane
  EXPECT_EQ (report ({"--parameterization", "flat.ply"}).at ("topology"), "disc");

  const std::vector<std::string> arguments{"in.pcd", "other.ply", "--loop", "bad.txt"};
  expectFailure (arguments, INPUT_FAILED, "cannot read 'bad.txt': there is no such file");
  writeFile ("bad.txt", "1 2\n3 -4\n");
  expectFailure (arguments, INPUT_FAILED, "line 2: '-4' is not the index of a point");
  writeFile ("bad.txt", "# nothing\n");
  expectFailure (arguments, INPUT_FAILED, "no indices");
  writeFile ("bad.txt", "1 2 3 1000000\n");
  expectFailure (arguments, RECONSTRUCTION_FAILED, "(INVALID_LOOP)");
}

TEST_F (CommandLineTest, TheMethodOfTheReportAndOptionsWithoutEffect)
{
  const Json made = report ({"--method", "tw385", "--cluster-tolerance", "0.2"});
  EXPECT_EQ (made["options"]["method"], "tw385");
  EXPECT_EQ (made["options"]["topology"], "disc");
  EXPECT_EQ (made["options"]["boundary"], "two-segments");
  EXPECT_THAT (made["warnings"].dump (), Not (HasSubstr ("no effect")));
  // What is given stays.
  const Json other = report (
      {"--method", "tw385", "--boundary", "spanning-tree", "--scatter", "drop", "--flips", "on"});
  EXPECT_EQ (other["options"]["boundary"], "spanning-tree");
  EXPECT_THAT (other["warnings"].dump (),
               HasSubstr ("options have no effect: --scatter, --flips; --method tw385"));
  std::vector<std::string> options = withOptions ("--topology surface --solver gauss-seidel");
  EXPECT_THAT (succeed (options).err, HasSubstr ("warning: an option has no effect: solver"));
}

// Share of the triangles that face up.
double
shareUp (const MeshContent& mesh)
{
  std::size_t up = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    up += (b - a).cross (c - a).z () > 0.0 ? 1 : 0;
  }
  return static_cast<double> (up) / static_cast<double> (mesh.triangles.size ());
}

// The wavy square of the sample, with normals that point down.
TEST_F (CommandLineTest, NormalsOfTheInputReachTheRun)
{
  sample_.normals.assign (sample_.size (), Eigen::Vector3f (0.1F, 0.0F, -1.0F));
  writePcd (path ("down.pcd"), sample_, PcdKind::BINARY);
  report ({}, "down.pcd");
  EXPECT_EQ (shareUp (readMesh (path ("out.ply"))), 1.0);
  EXPECT_EQ (report ({"--facing", "normals"}, "down.pcd").at ("facing_parts"),
             (Json{{"normals", 1}}));
  EXPECT_EQ (shareUp (readMesh (path ("out.ply"))), 0.0);
  const Json used = report ({"--use-input-normals", "on"}, "down.pcd");
  EXPECT_EQ (used.at ("options").at ("use_input_normals"), true);
  EXPECT_EQ (shareUp (readMesh (path ("out.ply"))), 0.0);
}

// The viewpoint of a PCD file is that of the sensor, unless it is (0, 0, 0), which nobody told.
// Shifts move the sensor and the viewpoint, too: without that, they would change sides.
TEST_F (CommandLineTest, ViewpointsReachTheRunAndAreShifted)
{
  std::string text = readFile ("in.pcd");
  const std::string place = "VIEWPOINT 0 0 0";
  writeFile ("below.pcd", text.replace (text.find (place), place.size (), "VIEWPOINT 5 5 -40"));
  for (const std::string shift : {"0,0,0", "0,0,100"}) {
    SCOPED_TRACE (shift);
    const Json all =
        report ({"--facing", "viewpoint", "--viewpoint", "none", "--shift", shift}, "below.pcd");
    EXPECT_EQ (all.at ("facing_parts"), (Json{{"sensor", 1}}));
    EXPECT_EQ (shareUp (readMesh (path ("out.ply"))), 0.0);
    report ({"--facing", "viewpoint", "--viewpoint", "5,5,-40", "--shift", shift});
    EXPECT_EQ (shareUp (readMesh (path ("out.ply"))), 0.0);
  }
  report ({"--facing", "viewpoint", "--shift", "5,5,40"}); // not a sensor below the ground
  EXPECT_EQ (shareUp (readMesh (path ("out.ply"))), 1.0);
}

// Longitude and latitude with heights in metres, by names, by the scales of LAS, or by extents.
TEST_F (CommandLineTest, DegreesAreTold)
{
  LasFile las;
  las.scale = {1e-7, 1e-7, 0.01};
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 900; ++i) {
    const double x = i % 30 * 1e-4, y = i / 30 * 1e-4, z = 5.0 * std::sin (0.3 * (i % 30));
    points.emplace_back (-70.1 + x, -33.2 + y, z);
    las.points.push_back ({static_cast<int> (1e7 * points.back ().x ()),
                           static_cast<int> (1e7 * points.back ().y ()),
                           static_cast<int> (100.0 * z)});
  }
  const auto told = [this] (const std::string& file, const std::string& bytes) {
    writeFile (file, bytes);
    return run ({file, "out.ply"}).err;
  };
  const auto text = [&points] (const std::string& header, double scale = 1.0) {
    std::ostringstream lines;
    lines << std::setprecision (10) << header;
    for (const Eigen::Vector3d& p : points)
      lines << scale * p.x () << ',' << scale * p.y () << ',' << p.z () << '\n';
    return lines.str ();
  };
  const auto isTold = HasSubstr ("+proj=utm +zone=19 +south (of");
  EXPECT_THAT (told ("a.csv", text ("longitude,latitude,depth\n")), isTold);
  EXPECT_THAT (told ("b.csv", text ("")), isTold);
  EXPECT_THAT (told ("c.las", lasBytes (las)), HasSubstr ("out_srs=EPSG:32719"));
  told ("d.csv", text ("longitude_m,latitude_m,z\n"));
  EXPECT_FALSE (readCloud (path ("d.csv")).may_be_degrees);
  EXPECT_THAT (told ("e.csv", text ("", 111e3)), Not (HasSubstr ("degrees")));
}

// Pixels without a return are no vertices, and neither are those with a NaN.
TEST_F (CommandLineTest, PixelsWithoutReturnAreLeftOut)
{
  std::vector<Eigen::Vector3d> points (20, Eigen::Vector3d (0, 0, 0));
  for (const Eigen::Vector3d& p : sample_.points)
    points.emplace_back (p + Eigen::Vector3d (0, 0, 30));
  points.emplace_back (std::nan (""), 0, 0);
  writeFile ("zeros.pcd", pcdText (points));
  const Json all = report ({}, "zeros.pcd");
  EXPECT_EQ (all["findings"][0]["id"], "invalid_pixels");
  EXPECT_EQ (all["non_finite"].size (), 21U);
  EXPECT_EQ (all["output"]["vertices"], sample_.size ());
  EXPECT_THAT (all["warnings"].dump (), HasSubstr ("20 points are at (0, 0, 0)"));
  EXPECT_THAT (all["warnings"].dump (), HasSubstr ("1 point without finite coordinates"));
  EXPECT_EQ (readMesh (path ("out.ply")).points.size (), sample_.size ());
  EXPECT_EQ (report ({"--remove-outliers", "off"}, "zeros.pcd")["output"]["vertices"],
             sample_.size () + 20);
}

// Coordinates far from zero: --shift, and the warning on coordinates that are too coarse.
class ShiftTest : public CommandLineTest
{
protected:
  // Points 0.3 m apart at map coordinates.
  ShiftTest ()
  {
    for (const Eigen::Vector3d& p : sample_.points)
      on_map_.emplace_back (Eigen::Vector3d (500123.4, 5500456.7, 312.0) + 0.3 * p);
    Sample sample = sample_;
    sample.is_double = true;
    sample.points = on_map_;
    writePcd (path ("double.pcd"), sample, PcdKind::BINARY);
    writeFile ("double.ply", plyText (sample, PlyKind::LITTLE));
    writeFile ("double.obj", objText (sample));
    // Text whose header says float, with more digits than that.
    writeFile ("text.pcd", pcdText (on_map_));
    std::string ply = plyText (sample, PlyKind::ASCII);
    for (std::size_t at = ply.find ("property double"); at != std::string::npos;
         at = ply.find ("property double"))
      ply.replace (at, 15, "property float");
    writeFile ("text.ply", ply);
    sample.is_double = false;
    writePcd (path ("float.pcd"), sample, PcdKind::BINARY);
  }

  /// Shifted back, the points of a mesh are those on the map.
  void expectOnMap (const MeshContent& mesh, const Eigen::Vector3d& shift, double tolerance) const
  {
    ASSERT_EQ (mesh.points.size (), on_map_.size ());
    for (std::size_t i = 0; i < on_map_.size (); ++i)
      EXPECT_LT ((mesh.points[i] + shift - on_map_[i]).norm (), tolerance);
  }

  std::vector<Eigen::Vector3d> on_map_;
};

TEST_F (ShiftTest, AutoMovesTheOriginToTheCloud)
{
  succeed ({"double.pcd", "plain.ply", "-q", "--precision", "double"});
  const MeshContent plain = readMesh (path ("plain.ply"));
  for (const std::string input :
       {"double.pcd", "double.ply", "double.obj", "text.pcd", "text.ply"}) {
    SCOPED_TRACE (input);
    const Json all = report ({"--shift", "auto"}, input);
    const Eigen::Vector3d shift (all.at ("shift")[0], all.at ("shift")[1], all.at ("shift")[2]);
    EXPECT_LT ((shift - on_map_.front ()).norm (), 10.0);
    EXPECT_EQ (shift, shift.array ().round ().matrix ());
    EXPECT_EQ (all.at ("statistics").at ("coordinate_step"), 0.0);
    const MeshContent mesh = readMesh (path ("out.ply"));
    EXPECT_FALSE (mesh.is_double);
    expectOnMap (mesh, shift, 1e-5);
    EXPECT_EQ (mesh.triangles, plain.triangles);
    EXPECT_NE (readFile ("out.ply").find ("\ncomment shift 5001"), std::string::npos);
  }
  // Gross outliers do not count.
  std::vector<Eigen::Vector3d> points = on_map_;
  points.emplace_back (0, 0, 0);
  points.emplace_back (1e10, 0, 0);
  writeFile ("far.pcd", pcdText (points));
  EXPECT_NEAR (report ({"--shift", "auto"}, "far.pcd").at ("shift")[0].get<double> (), 500123.4,
               10.0);
  // Near zero there is no need.
  const Json all = report ({"--shift", "auto"});
  EXPECT_EQ (all.at ("shift"), (Json{0.0, 0.0, 0.0}));
  EXPECT_EQ (readFile ("out.ply").find ("comment shift"), std::string::npos);
}

TEST_F (ShiftTest, AGivenOrigin)
{
  // Without one, it is chosen where 32 bits are too coarse.
  EXPECT_THAT (succeed ({"double.ply", "out.ply"}).out, HasSubstr ("too coarse for them"));
  EXPECT_EQ (report ({"--shift", "auto"}, "double.ply")["shift"],
             report ({}, "double.ply")["shift"]);
  for (const std::string output : {"out.ply", "out.vtk", "out.obj", "out.off", "out.stl"}) {
    SCOPED_TRACE (output);
    const Outcome outcome = succeed ({"double.ply", output, "--shift", "500000,5500000,-12.5"});
    EXPECT_THAT (outcome.out, HasSubstr ("shift      500000 5500000 -12.5, subtracted"));
    const std::string text = readFile (output);
    EXPECT_EQ (text.find ("shift 500000 5500000 -12.5") == std::string::npos, output == "out.stl");
    if (output != "out.stl")
      expectOnMap (readMesh (path (output)), {500000, 5500000, -12.5}, 1e-4);
  }
  // A first number below zero is no option.
  succeed ({"in.pcd", "out.ply", "-q", "--shift", "-5,0,0"});
  EXPECT_NEAR (readMesh (path ("out.ply")).points[0].x (), sample_.points[0].x () + 5.0, 1e-5);
}

TEST_F (ShiftTest, CoarseCoordinatesAreTold)
{
  for (const std::string input : {"float.pcd", "text.pcd"}) {
    const Json all = report ({"-q"}, input);
    EXPECT_GT (all.at ("statistics").at ("coordinate_step").get<double> (), 0.1);
    EXPECT_THAT (all.at ("warnings").dump (), HasSubstr ("the coordinates are coarse"));
  }
  succeed ({"double.pcd", "out.ply", "--precision", "double", "--strict"});
  succeed ({"text.pcd", "out.ply", "--strict", "--shift", "auto"});
}

TEST_F (CommandLineTest, JsonIsTheLastLine)
{
  for (const bool quiet : {false, true}) {
    const Outcome outcome = succeed ({"in.pcd", "out.ply", "--json", quiet ? "-q" : "--threads=1"});
    const std::string lines = outcome.out.substr (0, outcome.out.size () - 1);
    const std::size_t before = lines.rfind ('\n');
    EXPECT_EQ (before == std::string::npos, quiet);
    const Json summary = Json::parse (lines.substr (quiet ? 0 : before + 1));
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
    EXPECT_EQ (summary.at ("triangles"), readMesh (path ("out.ply")).triangles.size ());
  }
}

// A repeated point, and two without finite coordinates: the first one and one in between.
TEST_F (CommandLineTest, TheReportNamesPointsOfTheInput)
{
  std::vector<Eigen::Vector3d> points = sample_.points;
  points.insert (points.begin (), Eigen::Vector3d (std::nan (""), 0, 0));
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
  EXPECT_THAT (all.at ("warnings").dump (),
               HasSubstr ("2 points without finite coordinates were left out"));
  EXPECT_EQ (all.at ("statistics").at ("used_points"), sample_.size ());
  // The vertices after a point that was left out move up, and so do the indices of triangles.
  const MeshContent mesh = readMesh (path ("out.ply"));
  points.erase (points.begin () + 10);
  points.erase (points.begin ());
  EXPECT_EQ (mesh.points, points);
  for (const auto& triangle : mesh.triangles)
    for (const std::size_t corner : triangle) {
      ASSERT_LT (corner, sample_.size ());
      EXPECT_LT ((mesh.points[corner] - mesh.points[triangle[0]]).norm (), 4.0);
    }
}

TEST_F (CommandLineTest, TheReportHasFindingsAsData)
{
  std::vector<Eigen::Vector3d> points = sample_.points;
  points.emplace_back (0, 0, 1e6);
  writeFile ("in.pcd", pcdText (points));
  const Json findings = report ({}).at ("findings");
  ASSERT_EQ (findings.size (), 1U);
  EXPECT_EQ (findings[0].at ("id"), "gross_outliers");
  EXPECT_EQ (findings[0].at ("severity"), "note");
  EXPECT_EQ (findings[0].at ("numbers"), (Json{1, sample_.size ()}));
}

TEST_F (CommandLineTest, PointsOnOthersAreInTheMeshAndInTheReport)
{
  std::vector<Eigen::Vector3d> points = sample_.points;
  for (const Eigen::Vector3d& p : sample_.points)
    points.emplace_back (p + Eigen::Vector3d (0, 0, 0.01));
  writeFile ("in.pcd", pcdText (points));
  const Json all = report ({});
  EXPECT_EQ (all.at ("statistics").at ("used_points"), points.size ());
  EXPECT_EQ (all.at ("statistics").at ("stacked_points"), sample_.size ());
  EXPECT_LT (all.at ("statistics").at ("largest_stack_height"), 0.03);
  EXPECT_EQ (all.at ("findings").at (0).at ("id"), "stacked_points");
  EXPECT_EQ (all.at ("findings").at (0).at ("severity"), "note");
  EXPECT_THAT (succeed ({"in.pcd", "out.ply"}).out, HasSubstr ("\nstacks     "));
  EXPECT_EQ (report ({"--topology", "disc"}).at ("statistics").at ("stacked_points"), 0);
}

TEST_F (CommandLineTest, TheReportTellsWhatTheMeshIs)
{
  const Json all = report ({"--topology", "disc"});
  EXPECT_EQ (all.at ("topology"), "disc");
  EXPECT_EQ (all.at ("topology_reason"), "asked for");
  for (const char* list : {"outliers", "loop_decisions", "facing_decisions"})
    EXPECT_EQ (all.at (list), Json::array ()) << list;
  EXPECT_EQ (all.at ("facing_certainty"), 1.0);
  EXPECT_GT (all.at ("peak_memory_bytes").get<std::size_t> (), 1000000U);
  for (const char* stage : {"working set", "neighbors", "stars", "boundary", "weights", "solve",
                            "delaunay", "flips", "consensus", "holes", "check"})
    EXPECT_GE (all.at ("seconds").at (stage).get<double> (), 0.0) << stage;
  const Json &statistics = all.at ("statistics"), &check = all.at ("check");
  EXPECT_EQ (statistics.at ("working_points"), sample_.size ());
  EXPECT_EQ (statistics.at ("loop_points"), all.at ("loop").size ());
  EXPECT_EQ (statistics.at ("triangles"), all.at ("output").at ("triangles"));
  EXPECT_LT (statistics.at ("noise").get<double> (), 0.1);
  for (const char* figure :
       {"outlier_points", "holes_filled", "remade_points", "self_intersections_found",
        "self_intersection_flips", "self_intersection_moves", "self_intersection_rebuilds"})
    EXPECT_EQ (statistics.at (figure), 0) << figure;
  for (const char* flaw : {"nonmanifold_edges", "nonmanifold_vertices", "orientation_conflicts",
                           "genus", "folds", "degenerate_triangles", "self_intersections"})
    EXPECT_EQ (check.at (flaw), 0) << flaw;
  EXPECT_EQ (check.at ("self_intersections_at"), Json::array ());
  EXPECT_EQ (check.at ("components"), 1);
  EXPECT_EQ (check.at ("euler_characteristic"), 1);
  EXPECT_GT (check.at ("longest_edge").get<double> (), 1.0);
  EXPECT_EQ (check.at ("longest_edge_at").size (), 2U);
  ASSERT_EQ (check.at ("loops").size (), 1U);
  const Json &loop = check.at ("loops").front (), &points = all.at ("loop");
  EXPECT_GE (points.size (), 30U);
  EXPECT_EQ (loop.at ("points"), points.size ());
  EXPECT_EQ (loop.at ("at"), *std::min_element (points.begin (), points.end ()));
  EXPECT_GT (loop.at ("width").get<double> (), 10.0); // of a square of side 11
  EXPECT_GT (loop.at ("length").get<double> (), 2.0 * loop.at ("width").get<double> ());
  EXPECT_GT (loop.at ("width_spacings").get<double> (), 5.0);
}

TEST_F (CommandLineTest, StrictRefusesLostPointsAndPoorMeshes)
{
  writeFile ("out.ply", "what was there before");
  std::vector<Eigen::Vector3d> with_island = makeSample (false, 24).points;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      with_island.emplace_back (200.0 + i, j, 0.0);
  writeFile ("island.pcd", pcdText (with_island));
  const std::string cause = "36 points are in no triangle, point 576 (200, 0, 0) among them";
  for (const std::string quiet : {"--quiet", "--threads=0"}) {
    const Outcome outcome = run (
        {"island.pcd", "out.ply", "--report", "out.json", "--topology", "disc", quiet, "--strict"});
    EXPECT_EQ (outcome.code, REFUSED);
    EXPECT_EQ (outcome.out, "");
    EXPECT_THAT (outcome.err, StartsWith ("pcl_floater_reconstruct: cannot reconstruct "
                                          "'island.pcd': 36 points are in no triangle, which "
                                          "--strict does not allow "
                                          "(REFUSED)"));
    EXPECT_THAT (outcome.err, HasSubstr ("warning: " + cause));
    EXPECT_EQ (readFile ("out.ply"), "what was there before");
    const Json all = Json::parse (readFile ("out.json"));
    EXPECT_EQ (all.at ("status"), "REFUSED");
    EXPECT_EQ (all.at ("strict"), true);
    EXPECT_EQ (all.at ("output"), Json ());
    ASSERT_EQ (all.at ("warnings").size (), 1U);
    EXPECT_THAT (all.at ("warnings").front ().get<std::string> (), StartsWith (cause));
    EXPECT_EQ (all.at ("check").at ("components"), 1);
    std::filesystem::remove (path ("out.json"));
    EXPECT_EQ (names (), (std::set<std::string>{"in.pcd", "line.pcd", "island.pcd", "out.ply"}));
  }
  const Outcome summary =
      run ({"island.pcd", "out.ply", "--topology", "disc", "--strict", "--json"});
  EXPECT_EQ (Json::parse (summary.out).at ("status"), "REFUSED");
  EXPECT_EQ (Json::parse (summary.out).at ("output"), Json ());
  succeed ({"island.pcd", "lax.ply", "--topology", "disc", "-q"});
  // A good mesh is written; a run that fails anyway fails as without --strict.
  succeed ({"in.pcd", "good.ply", "--strict", "-q"});
  EXPECT_EQ (readMesh (path ("good.ply")).points, sample_.points);
  expectFailure ({"line.pcd", "out.ply", "--strict"}, RECONSTRUCTION_FAILED, "(DEGENERATE)");
}

// A shallow bowl is half a body or a valley.
TEST_F (CommandLineTest, TheReportTellsWhichSideMayNotBeTheFront)
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
  EXPECT_THAT (succeed ({"bowl.pcd", "out.ply", "--verbose"}).out,
               HasSubstr ("not sure   which side is the front of 1 part\n"));
  const Json all = report ({}, "bowl.pcd");
  ASSERT_EQ (all.at ("facing_decisions").size (), 1U);
  const Json& decision = all.at ("facing_decisions").front ();
  EXPECT_EQ (decision.at ("rule"), "body");
  EXPECT_EQ (decision.at ("certainty"), all.at ("facing_certainty"));
  EXPECT_EQ (decision.at ("triangles"), all.at ("statistics").at ("triangles"));
  EXPECT_LT (all.at ("facing_certainty").get<double> (), 0.9);
}

} // namespace
} // namespace pcl::floater
