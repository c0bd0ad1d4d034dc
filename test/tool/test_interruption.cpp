// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is ended by a signal leaves no files. --max-memory and --scratch: the mesh is the same
// as without them, and no files are left.
#include "tool_runner.h"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>

namespace pcl::floater {
namespace {
std::string
mapsOf (int process)
{
  std::ostringstream maps;
  maps << std::ifstream ("/proc/" + std::to_string (process) + "/maps").rdbuf ();
  return maps.str ();
}

class Interruption : public ToolTest
{
protected:
  void makeCloud (int side) const
  {
    writePcd (path ("in.pcd"), makeSample (false, side), PcdKind::BINARY);
  }

  /// Sends a signal when is_time (id of the process) is true: the run must end by that signal, and
  /// leave nothing. It may end by itself before that is noticed; then it is run again.
  void endsWhen (const std::function<bool (int)>& is_time, int signal_number,
                 const std::vector<std::string>& options = {}) const
  {
    SCOPED_TRACE (signal_number);
    std::vector<std::string> arguments{"in.pcd", "out.obj"};
    arguments.insert (arguments.end (), options.begin (), options.end ());
    Outcome outcome;
    for (int tries = 10; tries > 0 && outcome.code != -signal_number; --tries) {
      writeFile ("out.obj", "what was there before");
      outcome = interrupt (arguments, signal_number, is_time);
      ASSERT_TRUE (outcome.code == 0 || outcome.code == -signal_number) << outcome.err;
    }
    ASSERT_EQ (outcome.code, -signal_number) << "the moment was never noticed";
    EXPECT_EQ (outcome.out, "");
    EXPECT_EQ (names (), (std::set<std::string>{"in.pcd", "out.obj"}));
    EXPECT_EQ (readFile ("out.obj"), "what was there before");
  }
};

TEST_F (Interruption, LeavesNoPartOfAFile)
{
  makeCloud (250); // so large that its mesh takes several writes
  const auto is_at_work = [] (int process) {
    return mapsOf (process).find ("/in.pcd") != std::string::npos;
  };
  const auto is_writing = [this] (int) {
    const std::set<std::string> all = names ();
    return std::any_of (all.begin (), all.end (), [] (const std::string& name) {
      return name.rfind (".pcl_floater.", 0) == 0;
    });
  };
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    endsWhen (is_at_work, signal_number);
    endsWhen (is_writing, signal_number);
  }
}

TEST_F (Interruption, LeavesNoScratchFile)
{
  if (IS_SANITIZED)
    GTEST_SKIP () << "arrays stay in memory";
  makeCloud (200);
  const auto has_scratch = [this] (int process) {
    const std::string maps = mapsOf (process);
    const std::size_t at = maps.find (std::filesystem::canonical (path (".")).string ());
    return at != std::string::npos && maps.find ("(deleted)", at) != std::string::npos;
  };
  for (const int signal_number : {SIGINT, SIGTERM, SIGKILL})
    endsWhen (has_scratch, signal_number, {"--max-memory", "60M"});
}

using MaxMemory = Interruption;

/// With the smallest limit that the tool accepts for this cloud.
TEST_F (MaxMemory, SameMeshNearTheLimit)
{
  makeCloud (350);
  std::filesystem::create_directory (path ("scratch"));
  const std::string refusal = run ({"in.pcd", "none.ply", "--max-memory", "30M"}).err;
  const std::string before = "122500 points; use ";
  const std::size_t at = refusal.find (before), end = refusal.find ("M or more");
  ASSERT_TRUE (at != std::string::npos && end != std::string::npos) << refusal;
  const std::string megabytes = refusal.substr (at + before.size (), end - at - before.size ());
  const std::size_t limit = std::stoul (megabytes) * 1'000'000;

  EXPECT_EQ (report ({"--topology", "surface"}).at ("memory_limit"), Json ());
  const std::string free = readFile ("out.ply");
  const Json limited = report (
      {"--topology", "surface", "--max-memory", megabytes + "M", "--scratch", "scratch"}, "in.pcd");
  EXPECT_EQ (readFile ("out.ply"), free);
  EXPECT_TRUE (std::filesystem::is_empty (path ("scratch")));
  const Json& used = limited.at ("memory_limit");
  EXPECT_EQ (used.at ("bytes"), limit);
  EXPECT_EQ (used.at ("scratch"), "scratch");
  if (!IS_SANITIZED) { // whose arrays stay in memory
    EXPECT_GT (used.at ("scratch_peak_bytes"), 1'000'000);
    EXPECT_LT (limited.at ("peak_memory_bytes"), 2 * limit);
  }
}

/// A limit on file sizes stands for a full disk.
TEST_F (MaxMemory, ScratchFolderThatCannotBeUsed)
{
  makeCloud (300);
  for (const std::string folder : {"missing", "in.pcd", "/proc/self"})
    expectFailure ({"in.pcd", "out.ply", "--max-memory", "2G", "--scratch", folder}, OUTPUT_FAILED,
                   "cannot use the scratch folder '" + folder + "': ");
  if (IS_SANITIZED)
    GTEST_SKIP () << "arrays stay in memory";
  expectFailure ({"in.pcd", "out.ply", "--max-memory", "60M"}, INTERNAL_ERROR,
                 "no room in the scratch folder '.': File too large", {1 << 20});
}

} // namespace
} // namespace pcl::floater
