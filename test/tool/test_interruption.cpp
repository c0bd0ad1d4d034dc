// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is ended by a signal leaves no files.
#include "command_line_test.h"

#include <algorithm>
#include <chrono>
#include <csignal>

namespace pcl
{
namespace floater
{
namespace
{
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

  void expectNothingNew () const
  {
    EXPECT_EQ (names (), (std::set<std::string>{"in.pcd", "out.obj"}));
    EXPECT_EQ (readFile ("out.obj"), "what was there before");
  }
};

TEST_P (Interruption, AtWorkEndsAtOnce)
{
  const auto start = std::chrono::steady_clock::now ();
  auto sent = start;
  const Outcome outcome = interrupt ({"in.pcd", "out.obj"}, GetParam (), [&] (int) {
    sent = std::chrono::steady_clock::now ();
    return sent - start > std::chrono::milliseconds (50);
  });
  EXPECT_EQ (outcome.code, -GetParam ());
  EXPECT_LT (std::chrono::steady_clock::now () - sent, std::chrono::milliseconds (500));
  EXPECT_EQ (outcome.out, "");
  expectNothingNew ();
}

TEST_P (Interruption, WhileWritingLeavesNoPartOfAFile)
{
  // The tool may end before its temporary file is noticed; then it is run again.
  constexpr int TRIES = 10;
  for (int i = 0; i < TRIES; ++i) {
    const Outcome outcome =
        interrupt ({"in.pcd", "out.obj"}, GetParam (), [this] (int) { return isWriting (); });
    if (outcome.code == 0) {
      writeFile ("out.obj", "what was there before");
      continue;
    }
    EXPECT_EQ (outcome.code, -GetParam ());
    expectNothingNew ();
    return;
  }
  FAIL () << "the temporary file was never noticed";
}

INSTANTIATE_TEST_SUITE_P (Signals, Interruption, testing::Values (SIGINT, SIGTERM, SIGHUP));

} // namespace
} // namespace floater
} // namespace pcl
