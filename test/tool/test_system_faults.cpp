// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Each call of the system goes wrong once, in every way that it may: the run succeeds or fails with
// a message, and the output is the new file or the old one, whole.
#include "command_line_test.h"

#include <csignal>

namespace pcl::floater {
namespace {
const std::string OLD = "what was there before";

class SystemFaults : public CommandLineTest
{
protected:
  SystemFaults ()
  {
    writePcd (path ("in.pcd"), sample_, PcdKind::BINARY);
    EXPECT_EQ (run (arguments ()).code, 0);
    for (const char* name : {"out.ply", "flat.vtk"})
      expected_.push_back (readFile (name));
    std::filesystem::remove (path ("out.json"));
  }

  static std::vector<std::string> arguments ()
  {
    return {"in.pcd", "out.ply", "--report", "out.json", "--parameterization", "flat.vtk"};
  }

  struct Faulty
  {
    bool has_happened = false; ///< false: there are fewer such calls
    Outcome outcome;
    bool is_new = false;   ///< the mesh is the new one, else the old one
    bool has_rest = false; ///< a temporary file is left
  };

  /// Runs the tool with a fault, and checks that no output is a part of a file.
  Faulty runWith (const std::string& call, int n, const std::string& kind,
                  const std::vector<std::string>& arguments)
  {
    SCOPED_TRACE (call + " " + std::to_string (n) + " " + kind);
    writeFile ("out.ply", OLD);
    writeFile ("flat.vtk", OLD);
    std::filesystem::remove (path ("out.json"));
    Surroundings surroundings;
    surroundings.environment = {{"LD_PRELOAD", SYSTEM_FAULTS},
                                {"PCL_FLOATER_FAULT", call + ":" + std::to_string (n) + ":" + kind},
                                {"PCL_FLOATER_FAULT_MARK", path ("mark")},
                                {"PCL_FLOATER_FAULT_FILE", path ("in.pcd")}};
    Faulty faulty;
    faulty.outcome = runIn (surroundings, arguments);
    faulty.has_happened = std::filesystem::remove (path ("mark"));
    faulty.is_new = readFile ("out.ply") == expected_.front ();
    EXPECT_TRUE (faulty.is_new || readFile ("out.ply") == OLD);
    const std::string flat = readFile ("flat.vtk");
    EXPECT_TRUE (flat == OLD || flat == expected_.back ());
    if (names ().count ("out.json") != 0) {
      EXPECT_TRUE (Json::accept (readFile ("out.json")));
    }
    for (const std::string& name : names ())
      if (name.rfind (".pcl_floater.", 0) == 0) {
        faulty.has_rest = true;
        std::filesystem::remove (path (name));
      }
    return faulty;
  }

  /// All calls of this name, one after the other.
  /// \return how many there are
  int forEachCall (const std::string& call, const std::string& kind,
                   const std::function<void (const Faulty&)>& check)
  {
    constexpr int MOST = 1000;
    for (int n = 0; n < MOST; ++n) {
      const Faulty faulty = runWith (call, n, kind, arguments ());
      if (!faulty.has_happened) {
        EXPECT_EQ (faulty.outcome.code, 0) << faulty.outcome.err;
        EXPECT_TRUE (faulty.is_new);
        return n;
      }
      SCOPED_TRACE (call + " " + std::to_string (n) + " " + kind);
      check (faulty);
    }
    return MOST;
  }

  std::vector<std::string> expected_; // the mesh and the flat mesh
};

// Either all went well, or there is a message and all files are as they were.
TEST_F (SystemFaults, ErrorsAreToldOrDoNotMatter)
{
  int all = 0;
  for (const char* call : {"open", "read", "mmap", "fchmod", "write", "fsync"})
    for (const char* kind : {"EIO", "ENOSPC", "EACCES"})
      all += forEachCall (call, kind, [this] (const Faulty& faulty) {
        EXPECT_FALSE (faulty.has_rest);
        const Outcome& outcome = faulty.outcome;
        if (outcome.code == 0) {
          EXPECT_TRUE (faulty.is_new);
          return;
        }
        EXPECT_TRUE (outcome.code == INPUT_FAILED || outcome.code == OUTPUT_FAILED ||
                     outcome.code == INTERNAL_ERROR)
            << outcome.code << " " << outcome.err;
        EXPECT_NE (outcome.err.find ("pcl_floater_reconstruct: "), std::string::npos);
        EXPECT_FALSE (faulty.is_new);
        std::set<std::string> left = names ();
        left.erase ("out.json"); // tells of a reconstruction that has found no memory
        EXPECT_EQ (left, (std::set<std::string>{"in.pcd", "out.ply", "flat.vtk"}));
      });
  EXPECT_GE (all, 30);
}

// A file that has appeared stays; the message names the one that could not.
TEST_F (SystemFaults, AFailedRenameIsTold)
{
  const int renames = forEachCall ("rename", "EIO", [] (const Faulty& faulty) {
    EXPECT_FALSE (faulty.has_rest);
    EXPECT_EQ (faulty.outcome.code, OUTPUT_FAILED);
    EXPECT_NE (faulty.outcome.err.find ("cannot write '"), std::string::npos);
  });
  EXPECT_EQ (renames, 3);
}

TEST_F (SystemFaults, InterruptedAndShortWritesAreContinued)
{
  const auto expectSuccess = [] (const Faulty& faulty) {
    EXPECT_EQ (faulty.outcome.code, 0) << faulty.outcome.err;
    EXPECT_TRUE (faulty.is_new);
    EXPECT_FALSE (faulty.has_rest);
  };
  EXPECT_GE (forEachCall ("write", "EINTR", expectSuccess), 3);
  EXPECT_GE (forEachCall ("write", "short", expectSuccess), 3);
  EXPECT_GE (forEachCall ("fsync", "EINTR", expectSuccess), 3);
}

// Nothing but a temporary file may be left.
TEST_F (SystemFaults, KilledAtAnyCall)
{
  int all = 0;
  for (const char* call : {"mmap", "write", "fsync", "rename"})
    for (const char* kind : {"kill", "killed"})
      all += forEachCall (call, kind,
                          [] (const Faulty& faulty) { EXPECT_EQ (faulty.outcome.code, -SIGKILL); });
  EXPECT_GE (all, 20);
}

// The colours and normals of the input are read where it is mapped, while the outputs are written.
TEST_F (SystemFaults, InputThatShrinksWhileOutputsAreWritten)
{
  for (const char* call : {"fsync", "write"})
    forEachCall (call, "shrink", [this] (const Faulty& faulty) {
      EXPECT_FALSE (faulty.has_rest);
      EXPECT_TRUE (faulty.outcome.code == 0 || faulty.outcome.code == INPUT_FAILED)
          << faulty.outcome.code << " " << faulty.outcome.err;
      if (faulty.outcome.code == INPUT_FAILED) {
        EXPECT_NE (faulty.outcome.err.find ("truncated while it was in use"), std::string::npos);
      }
      writePcd (path ("in.pcd"), sample_, PcdKind::BINARY);
    });
}

// Nobody reads what is printed: the run ends as programs in a pipe do, and leaves nothing.
TEST_F (SystemFaults, AClosedPipeLeavesNothing)
{
  writeFile ("out.ply", OLD);
  writeFile ("flat.vtk", OLD);
  const std::set<std::string> before = names ();
  Surroundings closed;
  closed.has_closed_pipe = true;
  EXPECT_EQ (runIn (closed, arguments ()).code, -SIGPIPE);
  EXPECT_EQ (names (), before);
  EXPECT_EQ (readFile ("out.ply"), OLD);
}

} // namespace
} // namespace pcl::floater
