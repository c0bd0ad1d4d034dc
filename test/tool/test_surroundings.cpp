// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Runs without room to print, and with few addresses.
#include "command_line_test.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace pcl::floater {
namespace {
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

/// A terminal, from the side of the one who looks at it.
class Terminal
{
public:
  Terminal () : descriptor_ (::posix_openpt (O_RDWR | O_NOCTTY | O_NONBLOCK))
  {
    if (descriptor_ < 0 || ::grantpt (descriptor_) != 0 || ::unlockpt (descriptor_) != 0)
      throw std::runtime_error ("there is no terminal");
    name_ = ::ptsname (descriptor_);
    other_side_ = ::open (name_.c_str (), O_RDWR | O_NOCTTY); // keeps what was written
  }
  ~Terminal ()
  {
    ::close (other_side_);
    ::close (descriptor_);
  }
  Terminal (const Terminal&) = delete;
  Terminal& operator= (const Terminal&) = delete;
  Terminal (Terminal&&) = delete;
  Terminal& operator= (Terminal&&) = delete;

  const std::string& name () const { return name_; }

  /// All that was written since the last call.
  std::string read () const
  {
    std::string text;
    std::array<char, 4096> bytes{};
    for (ssize_t got = 0; (got = ::read (descriptor_, bytes.data (), bytes.size ())) > 0;)
      text.append (bytes.data (), static_cast<std::size_t> (got));
    return text;
  }

private:
  int descriptor_, other_side_ = -1;
  std::string name_;
};

TEST_F (RunSurroundings, ProgressIsShownOnTerminalsOnly)
{
  EXPECT_EQ (run ({"in.pcd", "out.ply"}).err, "");
  const Terminal terminal;
  Surroundings seen;
  seen.standard_error = terminal.name ();
  seen.environment = {{"TERM", "xterm"}};
  ASSERT_EQ (runIn (seen, {"in.pcd", "out.ply"}).code, 0);
  const std::string shown = terminal.read (), erase = "\r\033[K";
  EXPECT_EQ (shown.rfind (erase + "reading ...", 0), 0U) << shown;
  EXPECT_NE (shown.find (erase + "searching neighbours ..."), std::string::npos) << shown;
  EXPECT_NE (shown.find (erase + "writing ..."), std::string::npos) << shown;
  ASSERT_GE (shown.size (), erase.size ());
  EXPECT_EQ (shown.substr (shown.size () - erase.size ()), erase); // nothing is left of it
  ASSERT_EQ (runIn (seen, {"in.pcd", "out.ply", "--quiet"}).code, 0);
  EXPECT_EQ (terminal.read (), "");
  seen.environment = {{"TERM", "dumb"}}; // cannot erase a line
  ASSERT_EQ (runIn (seen, {"in.pcd", "out.ply"}).code, 0);
  EXPECT_EQ (terminal.read (), "");
}

TEST_F (RunSurroundings, AMeshIsNotWrittenToATerminal)
{
  const Terminal terminal;
  Surroundings seen;
  seen.standard_output = terminal.name ();
  const Outcome outcome = runIn (seen, {"in.pcd", "-", "--output-format", "ply"});
  EXPECT_EQ (outcome.code, OUTPUT_FAILED);
  EXPECT_NE (outcome.err.find ("cannot write to the standard output: it is a terminal"),
             std::string::npos)
      << outcome.err;
  EXPECT_EQ (terminal.read (), "");
}

TEST_F (RunSurroundings, OptionsWithoutEffectAreWarnedOf)
{
  const std::vector<std::string> surface{"in.pcd",  "out.ply",  "--topology",
                                         "surface", "--solver", "gauss-seidel"};
  const Outcome outcome = run (surface);
  EXPECT_EQ (outcome.code, 0);
  EXPECT_NE (outcome.err.find ("warning: an option has no effect: solver"), std::string::npos)
      << outcome.err;
  std::vector<std::string> strict = surface;
  strict.emplace_back ("--strict");
  EXPECT_EQ (run (strict).code, WARNINGS);
}

} // namespace
} // namespace pcl::floater
