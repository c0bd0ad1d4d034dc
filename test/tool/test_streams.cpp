// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The standard streams in place of files, and formats that no extension tells.
#include "command_line_test.h"
#include "mesh_files.h"

namespace pcl::floater {
namespace {
class StreamTest : public CommandLineTest
{
protected:
  StreamTest ()
  {
    EXPECT_EQ (run ({"in.pcd", "expected.ply"}).code, 0);
    EXPECT_EQ (run ({"in.pcd", "expected.vtk"}).code, 0);
    expected_ = readFile ("expected.ply");
  }

  Outcome runPiped (const std::vector<std::string>& arguments,
                    const std::string& standard_output = "") const
  {
    Surroundings surroundings;
    surroundings.standard_input = path ("in.pcd");
    surroundings.standard_output = standard_output;
    return runIn (surroundings, arguments);
  }

  std::string expected_;
};

TEST_F (StreamTest, APipeIsAnInput)
{
  const Outcome outcome = runPiped ({"-", "out.ply", "--input-format", "pcd"});
  ASSERT_EQ (outcome.code, 0) << outcome.err;
  EXPECT_EQ (readFile ("out.ply"), expected_);
  EXPECT_NE (outcome.out.find ("triangles"), std::string::npos);
}

TEST_F (StreamTest, TheStandardOutputTakesTheMeshAndNothingElse)
{
  const std::set<std::string> before = names ();
  for (const std::string format : {"ply", "vtk"}) {
    const Outcome outcome = runPiped (
        {"-", "-", "--input-format", "pcd", "--output-format", format, "--json", "--strict"});
    ASSERT_EQ (outcome.code, 0) << outcome.err;
    EXPECT_EQ (outcome.out, readFile ("expected." + format));
    EXPECT_NE (outcome.err.find ("triangles  "), std::string::npos) << outcome.err;
    EXPECT_NE (outcome.err.find ("mesh       to the standard output"), std::string::npos);
    EXPECT_NE (outcome.err.find ("{\"status\":\"SUCCESS\""), std::string::npos) << outcome.err;
  }
  EXPECT_EQ (names (), before);
  const Outcome quiet = run ({"in.pcd", "-", "--output-format", "ply", "-q"});
  EXPECT_EQ (quiet.code, 0);
  EXPECT_EQ (quiet.out, expected_);
  EXPECT_EQ (quiet.err, "");
}

TEST_F (StreamTest, AFailureLeavesTheStandardOutputEmpty)
{
  writeFile ("line.pcd", pcdText ({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}));
  expectFailure ({"line.pcd", "-", "--output-format", "ply"}, RECONSTRUCTION_FAILED,
                 "(DEGENERATE)");
  expectFailure ({"in.pcd", "-", "--output-format", "ply"}, OUTPUT_FAILED,
                 "cannot write to the standard output: File too large", 1000);
  const Outcome full =
      runPiped ({"-", "-", "--input-format", "pcd", "--output-format", "ply"}, "/dev/full");
  EXPECT_EQ (full.code, OUTPUT_FAILED);
  EXPECT_NE (full.err.find ("cannot write to the standard output: No space left"),
             std::string::npos)
      << full.err;
  EXPECT_EQ (readFile ("expected.ply"), expected_);
}

TEST_F (StreamTest, WhatStreamsNeed)
{
  expectFailure ({"-", "out.ply"}, USAGE,
                 "INPUT is the standard input: give its format by --input-format");
  expectFailure ({"in.pcd", "-"}, USAGE,
                 "OUTPUT is the standard output: give its format by --output-format");
  for (const std::string option : {"--report", "--loop", "--parameterization"})
    expectFailure ({"in.pcd", "out.ply", option, "-"}, USAGE,
                   option + " takes the name of a file, not -");
  Surroundings surroundings;
  surroundings.standard_input = "/dev/null";
  const Outcome empty = runIn (surroundings, {"-", "out.ply", "--input-format", "ply"});
  EXPECT_EQ (empty.code, INPUT_FAILED);
  EXPECT_NE (empty.err.find ("cannot read the standard input: nothing came from"),
             std::string::npos)
      << empty.err;
  const Outcome wrong = runPiped ({"-", "out.ply", "--input-format", "ply"});
  EXPECT_EQ (wrong.code, INPUT_FAILED);
  EXPECT_NE (wrong.err.find ("cannot read the standard input: it does not begin with 'ply'"),
             std::string::npos)
      << wrong.err;
}

TEST_F (StreamTest, FormatIsGivenByOption)
{
  std::filesystem::rename (path ("in.pcd"), path ("cloud.dat"));
  expectFailure ({"cloud.dat", "out.ply"}, INPUT_FAILED,
                 "its extension '.dat' is unknown; use .pcd, .ply");
  expectFailure ({"cloud.dat", "out.ply"}, INPUT_FAILED, "or give its format by --input-format");
  ASSERT_EQ (run ({"cloud.dat", "mesh", "--input-format", "pcd", "--output-format", "ply"}).code,
             0);
  EXPECT_EQ (readFile ("mesh"), expected_);
  expectFailure ({"cloud.dat", "out", "--input-format", "pcd"}, OUTPUT_FAILED,
                 "it has no extension that tells its format; use .vtk");
  // The option wins over the extension.
  std::filesystem::rename (path ("cloud.dat"), path ("cloud.ply"));
  ASSERT_EQ (run ({"cloud.ply", "out.vtk", "--input-format", "pcd", "--output-format", "ply"}).code,
             0);
  EXPECT_EQ (readFile ("out.vtk"), expected_);
}

} // namespace
} // namespace pcl::floater
