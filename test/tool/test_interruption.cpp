// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is ended by a signal leaves no files.
#include "command_line_test.h"

#include <algorithm>
#include <csignal>
#include <fstream>

namespace pcl::floater {
namespace {
// A bent sheet, so large that its mesh takes several writes.
std::vector<Eigen::Vector3d>
manyPoints ()
{
  constexpr int WIDTH = 250;
  constexpr double STEP = 0.37;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < WIDTH; ++i)
    for (int j = 0; j < WIDTH; ++j)
      points.emplace_back (i + 0.3 * std::sin (7.0 * j), j + 0.3 * std::sin (5.0 * i),
                           10.0 * std::sin (STEP * i / 10) * std::cos (STEP * j / 10));
  return points;
}

class Interruption : public ToolTestWith<int>
{
protected:
  Interruption ()
  {
    writeFile ("in.pcd", pcdText (manyPoints ()));
    writeFile ("out.obj", "what was there before");
  }

  bool isWriting () const
  {
    const std::set<std::string> all = names ();
    return std::any_of (all.begin (), all.end (), [] (const std::string& name) {
      return name.rfind (".pcl_floater.", 0) == 0;
    });
  }

  /// Whether the input file is mapped.
  static bool isReading (int process)
  {
    std::ifstream maps ("/proc/" + std::to_string (process) + "/maps");
    for (std::string line; std::getline (maps, line);)
      if (line.find ("/in.pcd") != std::string::npos)
        return true;
    return false;
  }

  /// Sends the signal when is_time (id of the process) is true: the run must end by that signal,
  /// and leave nothing. It may end by itself before that is noticed; then it is run again.
  void endsWhen (const std::function<bool (int)>& is_time) const
  {
    constexpr int TRIES = 10;
    for (int i = 0; i < TRIES; ++i) {
      const Outcome outcome = interrupt ({"in.pcd", "out.obj"}, GetParam (), is_time);
      if (outcome.code == 0) {
        writeFile ("out.obj", "what was there before");
        continue;
      }
      EXPECT_EQ (outcome.code, -GetParam ());
      EXPECT_EQ (outcome.out, "");
      EXPECT_EQ (names (), (std::set<std::string>{"in.pcd", "out.obj"}));
      EXPECT_EQ (readFile ("out.obj"), "what was there before");
      return;
    }
    FAIL () << "the moment was never noticed";
  }
};

TEST_P (Interruption, AtWorkEndsTheRun)
{
  endsWhen ([this] (int process) { return isReading (process); });
}

TEST_P (Interruption, WhileWritingLeavesNoPartOfAFile)
{
  endsWhen ([this] (int) { return isWriting (); });
}

INSTANTIATE_TEST_SUITE_P (Signals, Interruption, testing::Values (SIGINT, SIGTERM, SIGHUP));

} // namespace
} // namespace pcl::floater
