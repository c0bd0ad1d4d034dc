// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// --max-memory and --scratch: the mesh is the same as without them, wrong uses are refused, and no
// files are left.
#include "command_line_test.h"

#include <gmock/gmock.h>

#include <csignal>
#include <fstream>
#include <sstream>

namespace pcl::floater {
namespace {
using testing::HasSubstr;

// A sanitizer's own memory is resident, too.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool IS_SANITIZED = true;
#else
constexpr bool IS_SANITIZED = false;
#endif

class MaxMemory : public CommandLineTest
{
protected:
  /// Writes large.pcd, a cloud that needs more than the smallest limit.
  void makeLarge (int side)
  {
    writePcd (path ("large.pcd"), makeSample (false, side), PcdKind::BINARY);
  }

  Json reportOf (std::vector<std::string> arguments) const
  {
    arguments.insert (arguments.end (), {"--topology", "surface", "--report", "out.json"});
    const Outcome outcome = run (arguments);
    EXPECT_EQ (outcome.code, 0) << outcome.err;
    return Json::parse (readFile ("out.json"));
  }
};

/// With the smallest limit that the tool accepts for this cloud.
TEST_F (MaxMemory, SameMeshBelowTheLimit)
{
  makeLarge (350);
  std::filesystem::create_directory (path ("scratch"));
  const std::string refusal = run ({"large.pcd", "none.ply", "--max-memory", "52M"}).err;
  const std::string before = "122500 points; use ", after = "M or more";
  const std::size_t at = refusal.find (before), end = refusal.find (after);
  ASSERT_TRUE (at != std::string::npos && end != std::string::npos) << refusal;
  const std::string megabytes = refusal.substr (at + before.size (), end - at - before.size ());
  const std::size_t limit = std::stoul (megabytes) * 1'000'000;

  const Json free = reportOf ({"large.pcd", "free.ply"});
  EXPECT_EQ (free.at ("memory_limit"), Json ());
  const Json limited = reportOf (
      {"large.pcd", "limited.ply", "--max-memory", megabytes + "M", "--scratch", "scratch"});
  EXPECT_EQ (readFile ("free.ply"), readFile ("limited.ply"));
  EXPECT_TRUE (std::filesystem::is_empty (path ("scratch")));
  const Json& used = limited.at ("memory_limit");
  EXPECT_EQ (used.at ("bytes"), limit);
  EXPECT_EQ (used.at ("scratch"), "scratch");
  EXPECT_GT (used.at ("scratch_peak_bytes"), 1'000'000);
  EXPECT_GT (used.at ("dropped_bytes"), 1'000'000);
  if (!IS_SANITIZED) {
    EXPECT_LT (limited.at ("peak_memory_bytes"), limit);
  }
}

TEST_F (MaxMemory, WhatIsRefused)
{
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--max-memory", "much"}, "'much' is not a size, such as 500M or 2G"},
      {{"--max-memory", "0"}, "'0' is too small; it must be "},
      {{"--max-memory", "1M"}, "'1M' is too small; it must be "},
      {{"--scratch", "."}, "--scratch is of no use without --max-memory"},
      {{"--max-memory", "2G", "--topology", "disc"}, "of a disc"},
      {{"--max-memory", "2G", "--loop", "loop.txt"}, "of a disc"},
      {{"--max-memory", "2G", "--parameterization", "flat.ply"}, "of a disc"}};
  for (const auto& [options, cause] : cases) {
    SCOPED_TRACE (cause);
    std::vector<std::string> arguments{"in.pcd", "out.ply"};
    arguments.insert (arguments.end (), options.begin (), options.end ());
    expectFailure (arguments, USAGE, cause);
  }
}

TEST_F (MaxMemory, ScratchFolderThatCannotBeUsed)
{
  for (const std::string& folder : {std::string ("missing"), std::string ("in.pcd")}) {
    const std::vector<std::string> arguments{"in.pcd", "out.ply",   "--max-memory",
                                             "2G",     "--scratch", folder};
    expectFailure (arguments, OUTPUT_FAILED, "cannot use the scratch folder '" + folder + "': ");
  }
  expectFailure ({"in.pcd", "out.ply", "--max-memory", "2G", "--scratch", "/proc/self"},
                 OUTPUT_FAILED, "cannot use the scratch folder '/proc/self'");
}

/// A limit on file sizes stands for a full disk.
TEST_F (MaxMemory, ScratchFolderWithoutRoom)
{
  makeLarge (300);
  expectFailure ({"large.pcd", "out.ply", "--max-memory", "60M"}, INTERNAL_ERROR,
                 "no room in the scratch folder '.': File too large", 1 << 20);
}

TEST_F (MaxMemory, NothingIsLeftAfterASignal)
{
  makeLarge (200);
  const std::set<std::string> before = names ();
  const auto has_scratch = [this] (int process) {
    std::ostringstream maps;
    maps << std::ifstream ("/proc/" + std::to_string (process) + "/maps").rdbuf ();
    const std::string text = maps.str ();
    const std::size_t at = text.find (std::filesystem::canonical (path (".")).string ());
    return at != std::string::npos && text.find ("(deleted)", at) != std::string::npos;
  };
  for (const int signal_number : {SIGINT, SIGTERM, SIGKILL}) {
    SCOPED_TRACE (signal_number);
    const Outcome outcome =
        interrupt ({"large.pcd", "out.ply", "--max-memory", "60M"}, signal_number, has_scratch);
    EXPECT_EQ (outcome.code, -signal_number) << outcome.err;
    EXPECT_EQ (names (), before);
  }
}

} // namespace
} // namespace pcl::floater
