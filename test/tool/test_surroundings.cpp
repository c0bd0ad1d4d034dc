// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Runs without room to print, and with few addresses.
#include "command_line_test.h"

namespace pcl
{
namespace floater
{
namespace
{
using RunSurroundings = CommandLineTest;

// Files appear after the summary: what cannot be printed does not change any.
TEST_F (RunSurroundings, AStandardOutputThatFailsLeavesFilesAsTheyWere)
{
  Surroundings full;
  full.standard_output = "/dev/full";
  writeFile ("out.ply", "what was there before");
  const std::set<std::string> before = names ();
  const std::vector<std::vector<std::string>> all{{"in.pcd", "out.ply", "--report", "out.json"},
                                                  {"in.pcd", "out.ply", "-q", "--json"}};
  for (const std::vector<std::string>& arguments : all) {
    const Outcome outcome = runIn (full, arguments);
    EXPECT_EQ (outcome.code, OUTPUT_FAILED);
    EXPECT_NE (outcome.err.find ("standard output"), std::string::npos) << outcome.err;
    EXPECT_EQ (names (), before);
    EXPECT_EQ (readFile ("out.ply"), "what was there before");
  }
  EXPECT_EQ (runIn (full, {"in.pcd", "out.ply", "--quiet"}).code, 0); // prints nothing
  EXPECT_NE (readFile ("out.ply"), "what was there before");
}

// Below some limit the threads of OpenBLAS find no memory when the program starts, and wait for it.
// Neither a run that needs no linear system nor one that fails may wait for them.
TEST_F (RunSurroundings, FewAddressesDoNotKeepARunFromEnding)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP () << "a sanitizer itself needs more addresses than are given here";
#endif
  constexpr std::size_t MEGABYTE = 1'000'000;
  for (const std::size_t megabytes : {100U, 130U, 160U, 200U, 300U}) {
    SCOPED_TRACE (megabytes);
    Surroundings few;
    few.address_limit = megabytes * MEGABYTE;
    for (const std::string topology : {"surface", "disc"}) {
      const Outcome outcome = runIn (few, {"in.pcd", "out.ply", "--topology", topology});
      if (outcome.code == 127)
        continue; // the libraries alone take more
      EXPECT_TRUE (outcome.code == 0 || outcome.code == INTERNAL_ERROR) << outcome.code;
      EXPECT_EQ (outcome.code == 0, names ().count ("out.ply") == 1);
      if (outcome.code != 0) {
        EXPECT_NE (outcome.err.find ("not enough memory"), std::string::npos) << outcome.err;
      }
      std::filesystem::remove (path ("out.ply"));
    }
    const int version = runIn (few, {"--version"}).code;
    EXPECT_TRUE (version == 0 || version == 127) << version;
  }
}

TEST_F (RunSurroundings, OptionsWithoutEffectAreWarnedOf)
{
  const std::vector<std::string> surface{"in.pcd",  "out.ply",  "--topology",
                                         "surface", "--solver", "gauss-seidel"};
  const Outcome outcome = run (surface);
  EXPECT_EQ (outcome.code, 0);
  EXPECT_NE (outcome.err.find ("warning: an option has no effect: the solver"), std::string::npos)
      << outcome.err;
  std::vector<std::string> strict = surface;
  strict.emplace_back ("--strict");
  EXPECT_EQ (run (strict).code, WARNINGS);
  EXPECT_EQ (
      run ({"in.pcd", "out.ply", "--holes", "keep-largest", "--kept-loops", "3", "--strict"}).code,
      WARNINGS);
  EXPECT_EQ (
      run ({"in.pcd", "out.ply", "--topology", "disc", "--weights", "uniform", "--strict"}).code,
      0);
}

} // namespace
} // namespace floater
} // namespace pcl
