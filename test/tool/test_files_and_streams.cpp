// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a run reads, prints and writes: files, the standard streams, terminals. What fails leaves
// everything as it was.
#include "remaining_time.h"
#include "tool_runner.h"

#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace pcl::floater {
namespace {
const std::string BEFORE = "what was there before";

TEST_F (CommandLineTest, InputsThatCannotBeRead)
{
  std::filesystem::create_directory (path ("folder.pcd"));
  writeFile ("empty.pcd", "");
  for (const std::string name :
       {"bad.ply", "bad.obj", "bad.stl", "bad.las", "bad.csv", "bad.off", "bad.e57"})
    writeFile (name, "hello\n");
  for (const auto& [name, cause] : std::vector<std::pair<std::string, std::string>>{
           {"missing.pcd", "there is no such file"},
           {"folder.pcd", "it is a folder"},
           {"empty.pcd", "the file is empty"},
           {"bad.ply", "it does not begin with 'ply'"},
           {"bad.obj", "it has no points"},
           {"bad.stl", "it is too short for a binary STL file"},
           {"bad.las", "it is not a LAS file"},
           {"bad.csv", "it has no points"},
           {"bad.off", "its extension '.off' is unknown; use .pcd, .ply"},
           {"bad.off", "or give its format by --input-format"},
           {"bad.e57", "pdal translate a.e57"}})
    expectFailure ({name, "out.ply", "--report", "out.json"}, INPUT_FAILED, cause);
  EXPECT_THAT (run ({"bad.ply", "out.ply"}).err, HasSubstr ("cannot read 'bad.ply': "));
}

TEST_F (CommandLineTest, CloudsOfWhichNoSurfaceCanBeMade)
{
  writeFile ("out.ply", BEFORE);
  writeFile ("place.pcd", pcdText (std::vector<Eigen::Vector3d> (50, {1, 2, 3})));
  writeFile ("nan.pcd", pcdText (std::vector<Eigen::Vector3d> (50, {std::nan (""), 2, 3})));
  const std::map<std::string, std::string> statuses{
      {"place.pcd", "TOO_FEW_POINTS"}, {"nan.pcd", "TOO_FEW_POINTS"}, {"line.pcd", "DEGENERATE"}};
  for (const auto& [cloud, status] : statuses) {
    expectFailure ({cloud, "out.ply"}, RECONSTRUCTION_FAILED, "(" + status + ")");
    const Outcome outcome = run ({cloud, "out.ply", "--report", "out.json", "--json"});
    EXPECT_EQ (outcome.code, RECONSTRUCTION_FAILED);
    EXPECT_EQ (Json::parse (outcome.out).at ("status"), status);
    const Json all = Json::parse (readFile ("out.json"));
    EXPECT_EQ (all.at ("status"), status);
    EXPECT_EQ (all.at ("check"), Json ()); // without a mesh there is nothing to check
    EXPECT_EQ (readFile ("out.ply"), BEFORE);
    std::filesystem::remove (path ("out.json"));
  }
}

TEST_F (CommandLineTest, OddFilesAreTold)
{
  writeFile ("more.pcd", pcdText (sample_.points) + "7 7 7\n");
  EXPECT_THAT (succeed ({"more.pcd", "out.ply"}).err,
               HasSubstr ("has more data than the 144 points"));
  std::string text = readFile ("in.pcd");
  const std::string line = "SIZE 4 4 4\n";
  writeFile ("odd.pcd", text.erase (text.find (line), line.size ()));
  EXPECT_THAT (succeed ({"odd.pcd", "out.ply"}).err,
               HasSubstr ("warning: the PCD header has no SIZE"));
  EXPECT_EQ (readMesh (path ("out.ply")).points, sample_.points);
  succeed ({"odd.pcd", "out.ply", "--strict"}); // the mesh is good
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
    expectFailure ({"in.pcd", "out.ply", "--html", output}, OUTPUT_FAILED, cause);
    expectFailure ({"in.pcd", "out.ply", "--parameterization", output}, OUTPUT_FAILED, cause);
  }
  expectFailure ({"in.pcd", "out.xyz"}, OUTPUT_FAILED, "its extension '.xyz' is unknown");
  expectFailure ({"in.pcd", "out"}, OUTPUT_FAILED, "it has no extension that tells its format");
  expectFailure ({"in.pcd", "out.ply", "--parameterization", "out.png"}, OUTPUT_FAILED,
                 "'.png' is unknown");
  expectFailure ({"in.pcd", "out.obj", "--texture", "nowhere/c.png"}, OUTPUT_FAILED, "nowhere");
  // Paths are checked first: with a bad output, the missing input is not even noticed.
  expectFailure ({"missing.pcd", "missing/out.ply"}, OUTPUT_FAILED, "there is no folder");
  EXPECT_TRUE (std::filesystem::is_symlink (path ("full.ply")));
  EXPECT_TRUE (std::filesystem::is_character_file ("/dev/full"));
}

/// As on a full disk: the write fails when a part of the file has been written. No part of any
/// output is left.
TEST_F (CommandLineTest, WriteThatFailsHalfWay)
{
  writeFile ("out.ply", BEFORE);
  for (const std::string name : {"out.vtk", "out.ply", "out.obj", "out.stl", "out.off", "out.glb"})
    expectFailure ({"in.pcd", name, "--report", "out.json"}, OUTPUT_FAILED,
                   "cannot write '" + name + "': File too large", {1000});
  // The mesh fits, the flat mesh as text does not: neither appears.
  succeed ({"in.pcd", "fits.ply", "-q", "--topology", "disc"});
  const std::size_t limit = std::filesystem::file_size (path ("fits.ply")) + 100;
  expectFailure ({"in.pcd", "out.ply", "--parameterization", "flat.obj"}, OUTPUT_FAILED,
                 "cannot write 'flat.obj'", {limit});
  expectFailure ({"in.pcd", "out.ply", "--html", "out.html"}, OUTPUT_FAILED,
                 "cannot write 'out.html'", {limit});
  EXPECT_EQ (readFile ("out.ply"), BEFORE);
}

TEST_F (CommandLineTest, OutputIsReplacedAndKeepsLinkAndPermissions)
{
  writeFile ("target.ply", "old");
  using std::filesystem::perms;
  std::filesystem::permissions (path ("target.ply"), perms::owner_read | perms::owner_write);
  std::filesystem::create_symlink ("target.ply", path ("out.ply"));
  succeed ({"in.pcd", "out.ply", "-q"});
  EXPECT_TRUE (std::filesystem::is_symlink (path ("out.ply")));
  EXPECT_EQ (readMesh (path ("target.ply")).points, sample_.points);
  EXPECT_EQ (std::filesystem::status (path ("target.ply")).permissions (),
             perms::owner_read | perms::owner_write);
}

TEST_F (CommandLineTest, TheSummaryNamesFiguresAndFileUnlessItIsQuiet)
{
  const Outcome quiet = succeed ({"--quiet", "in.pcd", "out.vtk"}),
                loud = succeed ({"in.pcd", "out.vtk"});
  EXPECT_EQ (quiet.out + quiet.err, "");
  EXPECT_EQ (names (), (std::set<std::string>{"in.pcd", "line.pcd", "out.vtk"}));
  for (const char* part : {"points     144", "0 outliers", "triangles", "topology   ",
                           "1 component, genus 0, with boundary", "loops      1 of", "seconds",
                           "warnings   0", "mesh       out.vtk"})
    EXPECT_THAT (loud.out, HasSubstr (part));
  EXPECT_EQ (loud.out.find ('{'), std::string::npos);
}

TEST_F (CommandLineTest, NamesWithSpacesCapitalsAndBytesThatAreNotUtf8)
{
  const std::string name = "my cloud \xe4";
  writeFile (name + ".PCD", pcdText (sample_.points));
  succeed ({name + ".PCD", name + ".PLY", "--report", name + ".json", "--json"});
  std::filesystem::rename (path (name + ".PLY"), path ("out.ply"));
  EXPECT_EQ (readMesh (path ("out.ply")).points, sample_.points);
  EXPECT_TRUE (Json::accept (readFile (name + ".json")));
}

class StreamTest : public CommandLineTest
{
protected:
  StreamTest ()
  {
    succeed ({"in.pcd", "expected.ply"});
    succeed ({"in.pcd", "expected.vtk"});
    expected_ = readFile ("expected.ply");
    piped_.standard_input = path ("in.pcd");
  }

  std::string expected_;
  Surroundings piped_;
};

TEST_F (StreamTest, APipeIsAnInput)
{
  const Outcome outcome = run ({"-", "out.ply", "--input-format", "pcd"}, piped_);
  ASSERT_EQ (outcome.code, 0) << outcome.err;
  EXPECT_EQ (readFile ("out.ply"), expected_);
  EXPECT_THAT (outcome.out, HasSubstr ("triangles"));
  expectFailure ({"-", "out.ply", "--input-format", "ply"}, INPUT_FAILED,
                 "cannot read the standard input: it does not begin with 'ply'", piped_);
  piped_.standard_input = "/dev/null";
  expectFailure ({"-", "out.ply", "--input-format", "ply"}, INPUT_FAILED,
                 "cannot read the standard input: nothing came from", piped_);
  expectFailure ({"-", "out.ply"}, USAGE,
                 "INPUT is the standard input: give its format by --input-format");
}

TEST_F (StreamTest, TheStandardOutputTakesTheMeshAndNothingElse)
{
  const std::set<std::string> before = names ();
  for (const std::string format : {"ply", "vtk"}) {
    const Outcome outcome =
        run ({"-", "-", "--input-format", "pcd", "--output-format", format, "--json", "--strict"},
             piped_);
    ASSERT_EQ (outcome.code, 0) << outcome.err;
    EXPECT_EQ (outcome.out, readFile ("expected." + format));
    for (const char* part :
         {"triangles  ", "mesh       to the standard output", "{\"status\":\"SUCCESS\""})
      EXPECT_THAT (outcome.err, HasSubstr (part));
  }
  EXPECT_EQ (names (), before);
  const Outcome quiet = succeed ({"in.pcd", "-", "--output-format", "ply", "-q"});
  EXPECT_EQ (quiet.out, expected_);
  EXPECT_EQ (quiet.err, "");
  expectFailure ({"in.pcd", "-"}, USAGE,
                 "OUTPUT is the standard output: give its format by --output-format");
}

// Files appear after the summary: what cannot be printed does not change any.
TEST_F (StreamTest, AFailureOfTheStandardOutputLeavesFilesAsTheyWere)
{
  const std::vector<std::string> to_output{"in.pcd", "-", "--output-format", "ply"};
  expectFailure ({"line.pcd", "-", "--output-format", "ply"}, RECONSTRUCTION_FAILED,
                 "(DEGENERATE)");
  expectFailure (to_output, OUTPUT_FAILED, "cannot write to the standard output: File too large",
                 {1000});
  Surroundings full;
  full.standard_output = "/dev/full";
  writeFile ("out.ply", BEFORE);
  const Outcome outcome = run (to_output, full);
  EXPECT_EQ (outcome.code, OUTPUT_FAILED);
  EXPECT_THAT (outcome.err, HasSubstr ("cannot write to the standard output: No space left"));
  expectFailure ({"in.pcd", "out.ply", "--report", "out.json"}, OUTPUT_FAILED, "standard output",
                 full);
  expectFailure ({"in.pcd", "out.ply", "-q", "--json"}, OUTPUT_FAILED, "standard output", full);
  EXPECT_EQ (readFile ("out.ply"), BEFORE);
  EXPECT_EQ (run ({"in.pcd", "out.ply", "--quiet"}, full).code, 0); // prints nothing
  EXPECT_EQ (readFile ("out.ply"), expected_);
}

TEST_F (StreamTest, FormatIsGivenByOption)
{
  std::filesystem::rename (path ("in.pcd"), path ("cloud.ply")); // the option wins over that
  const std::vector<std::string> formats{"--input-format", "pcd", "--output-format", "ply"};
  for (const std::string output : {"mesh", "out.vtk"}) {
    std::vector<std::string> arguments{"cloud.ply", output};
    arguments.insert (arguments.end (), formats.begin (), formats.end ());
    succeed (arguments);
    EXPECT_EQ (readFile (output), expected_);
  }
  expectFailure ({"cloud.ply", "out", "--input-format", "pcd"}, OUTPUT_FAILED,
                 "it has no extension that tells its format; use .vtk");
}

// Below some limit the threads of OpenBLAS find no memory when the program starts, and wait for it.
// Neither a run that needs no linear system nor one that fails may wait for them.
TEST_F (CommandLineTest, FewAddressesDoNotKeepARunFromEnding)
{
  if (IS_SANITIZED)
    GTEST_SKIP () << "a sanitizer itself needs more addresses than are given here";
  constexpr std::size_t MEGABYTE = 1'000'000;
  for (const std::size_t megabytes : {100U, 130U, 160U, 200U, 300U}) {
    SCOPED_TRACE (megabytes);
    Surroundings few;
    few.address_limit = megabytes * MEGABYTE;
    for (const std::string topology : {"surface", "disc"}) {
      const Outcome outcome = run ({"in.pcd", "out.ply", "--topology", topology}, few);
      if (outcome.code == 127)
        continue; // the libraries alone take more
      EXPECT_TRUE (outcome.code == 0 || outcome.code == INTERNAL_ERROR) << outcome.code;
      EXPECT_EQ (outcome.code == 0, names ().count ("out.ply") == 1);
      if (outcome.code != 0) {
        EXPECT_THAT (outcome.err, HasSubstr ("not enough memory"));
      }
      std::filesystem::remove (path ("out.ply"));
    }
    const int version = run ({"--version"}, few).code;
    EXPECT_TRUE (version == 0 || version == 127) << version;
  }
}

/// With a terminal, from the side of the one who looks at it.
class TerminalTest : public CommandLineTest
{
protected:
  TerminalTest () : descriptor_ (::posix_openpt (O_RDWR | O_NOCTTY | O_NONBLOCK))
  {
    if (descriptor_ < 0 || ::grantpt (descriptor_) != 0 || ::unlockpt (descriptor_) != 0)
      throw std::runtime_error ("there is no terminal");
    name_ = ::ptsname (descriptor_);
    other_side_ = ::open (name_.c_str (), O_RDWR | O_NOCTTY); // keeps what was written
  }
  ~TerminalTest () override
  {
    ::close (other_side_);
    ::close (descriptor_);
  }

  /// All that was written since the last call.
  std::string shown () const
  {
    std::string text;
    std::array<char, 4096> bytes{};
    for (ssize_t got = 0; (got = ::read (descriptor_, bytes.data (), bytes.size ())) > 0;)
      text.append (bytes.data (), static_cast<std::size_t> (got));
    return text;
  }

  int descriptor_, other_side_ = -1;
  std::string name_;
};

TEST_F (TerminalTest, ProgressIsShownOnTerminalsOnly)
{
  EXPECT_EQ (run ({"in.pcd", "out.ply"}).err, "");
  Surroundings seen;
  seen.standard_error = name_;
  seen.environment = {{"TERM", "xterm"}};
  ASSERT_EQ (run ({"in.pcd", "out.ply"}, seen).code, 0);
  const std::string text = shown (), erase = "\r\033[K";
  EXPECT_THAT (text, StartsWith (erase + "reading ..."));
  EXPECT_THAT (text, HasSubstr (erase + "searching neighbours ..."));
  EXPECT_THAT (text, HasSubstr (erase + "writing ..."));
  EXPECT_THAT (text, testing::EndsWith (erase)); // nothing is left of it
  ASSERT_EQ (run ({"in.pcd", "out.ply", "--quiet"}, seen).code, 0);
  EXPECT_EQ (shown (), "");
  seen.environment = {{"TERM", "dumb"}}; // cannot erase a line
  ASSERT_EQ (run ({"in.pcd", "out.ply"}, seen).code, 0);
  EXPECT_EQ (shown (), "");
}

TEST_F (TerminalTest, AMeshIsNotWrittenToATerminal)
{
  Surroundings seen;
  seen.standard_output = name_;
  expectFailure ({"in.pcd", "-", "--output-format", "ply"}, OUTPUT_FAILED,
                 "cannot write to the standard output: it is a terminal", seen);
  EXPECT_EQ (shown (), "");
}

TEST (RemainingTime, IsToldOfLongRunsAndExactOfASteadyOne)
{
  RemainingTime remaining;
  remaining.update (1.0, 0.5);
  EXPECT_EQ (remaining.text (), "");
  remaining.update (4.0, 0.001);
  EXPECT_EQ (remaining.text (), "");
  RemainingTime steady;
  for (double seconds = 0.0; seconds <= 190.5; seconds += 0.05) {
    steady.update (seconds, seconds / 200.0);
    if (std::abs (seconds - 49.95) < 0.01) {
      EXPECT_NEAR (steady.left ().value (), 150.0, 0.1);
      EXPECT_EQ (steady.text (), "24 %, 3 min left");
    }
  }
  EXPECT_EQ (steady.text (), "95 %, 10 s left");
}

TEST (RemainingTime, IsSmooth)
{
  // The second half of the run takes four times as long as the first.
  RemainingTime remaining;
  double before = 0.0;
  for (double seconds = 0.05; seconds <= 50.0; seconds += 0.05) {
    remaining.update (seconds, seconds < 10.0 ? seconds / 20.0 : 0.5 + (seconds - 10.0) / 80.0);
    const double left = remaining.left ().value_or (0.0);
    if (seconds > 2.0) {
      EXPECT_LT (std::abs (left - before), 1.0);
    }
    before = left;
  }
  EXPECT_LT (before, 2.0);
}

// Names from files do not control the terminal.
TEST_F (CommandLineTest, EscapeSequencesAreShownAsText)
{
  std::string rows;
  for (int i = 0; i < 100; ++i)
    rows += std::to_string (i % 10) + "," + std::to_string (i / 10) + "," + std::to_string (i % 3) +
            ",abc\n";
  writeFile ("escape.csv", "x,y,z,\x1b[31mred\xc2\x9b\n" + rows);
  const Outcome outcome = succeed ({"escape.csv", "out.ply"});
  EXPECT_EQ ((outcome.err + outcome.out).find_first_of ("\x1b\x9b"), std::string::npos)
      << outcome.err;
  EXPECT_THAT (outcome.err, HasSubstr ("'\\x1b'"));
  expectFailure ({"no\x1b[31m.xyz", "out.ply"}, INPUT_FAILED, "no\\x1b[31m.xyz");
}

} // namespace
} // namespace pcl::floater
