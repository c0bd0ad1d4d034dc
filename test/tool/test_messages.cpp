// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Messages for command lines that are wrong: they name what was typed, and what may be meant.
#include "command_line_test.h"
#include "suggestion.h"

#include <gmock/gmock.h>

namespace pcl::floater {
namespace {
using testing::ElementsAre;
using testing::IsEmpty;

TEST (Suggestions, DistancesCountInsertedDroppedReplacedAndSwappedLetters)
{
  EXPECT_EQ (editDistance ("", ""), 0U);
  EXPECT_EQ (editDistance ("", "abc"), 3U);
  EXPECT_EQ (editDistance ("abc", ""), 3U);
  EXPECT_EQ (editDistance ("threads", "threads"), 0U);
  EXPECT_EQ (editDistance ("Threads", "tHREADS"), 0U);
  EXPECT_EQ (editDistance ("thread", "threads"), 1U);
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

struct Mistake
{
  std::vector<std::string> arguments; // after INPUT and OUTPUT
  std::string message;                // all of the first line
};

TEST_F (CommandLineTest, MessagesNameWhatWasTyped)
{
  const std::vector<Mistake> mistakes{
      {{"--thread", "4"}, "there is no option --thread; did you mean --threads?"},
      {{"--neighbours", "9"}, "there is no option --neighbours; did you mean --neighbors?"},
      {{"--frobnicate"}, "there is no option --frobnicate"},
      {{"--facing", "outward"},
       "--facing: 'outward' is none of: auto, outwards, up, viewpoint, normals; did you mean "
       "outwards?"},
      {{"--holes", "close_all"},
       "--holes: 'close_all' is none of: auto, close-all, keep-largest, keep-count, by-size; did "
       "you mean close-all?"},
      {{"-k", "20x"}, "-k: '20x' is not a whole number"},
      {{"--neighbors", "20x"}, "--neighbors: '20x' is not a whole number"},
      {{"-k", "5"}, "-k must be from 6 to 200"},
      {{"--largest-hole-length", "-1"}, "--largest-hole-length must be 0 or more"},
      {{"-k"}, "-k needs a value, N"},
      {{"-k", "20", "--neighbors", "30"}, "--neighbors is given 2 times; give it once"},
      {{"--strict=maybe"}, "--strict takes no value, but has 'maybe'"},
      {{"third.ply"}, "'third.ply' is one file too many: there are one INPUT and one OUTPUT"},
      {{"--shift", "centre"},
       "--shift: 'centre' is neither auto nor three numbers, such as 500000,5500000,0"},
      {{"--max-memory", "lots"}, "--max-memory: 'lots' is not a size, such as 500M or 2G"}};
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE (mistake.message);
    std::vector<std::string> arguments{"in.pcd", "out.ply"};
    arguments.insert (arguments.end (), mistake.arguments.begin (), mistake.arguments.end ());
    const Outcome outcome = run (arguments);
    EXPECT_EQ (outcome.code, USAGE);
    EXPECT_EQ (outcome.err, "pcl_floater_reconstruct: " + mistake.message + "\nTry --help.\n");
  }
}

// An option that is mistyped is told before what else is missing.
TEST_F (CommandLineTest, MistypedOptionsComeFirst)
{
  EXPECT_EQ (run ({"--hlep"}).err,
             "pcl_floater_reconstruct: there is no option --hlep; did you mean --help?\nTry "
             "--help.\n");
  EXPECT_EQ (run ({"in.pcd"}).err, "pcl_floater_reconstruct: OUTPUT is required; the simplest "
                                   "command is pcl_floater_reconstruct scan.pcd mesh.ply\nTry "
                                   "--help.\n");
}

} // namespace
} // namespace pcl::floater
