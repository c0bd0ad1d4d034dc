// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Each call of the system goes wrong once, in every way that it may: the run succeeds or fails with
// a message, and the output is the new file or the old one, whole.
#include "tool_runner.h"

#include <csignal>

namespace pcl::floater {
namespace {
const std::string OLD = "what was there before";

struct Faulty
{
  Outcome outcome;
  bool is_new = false;   ///< the mesh is the new one, else the old one
  bool has_rest = false; ///< a temporary file is left
};

class SystemFaults : public ToolTest
{
protected:
  SystemFaults ()
  {
    writePcd (path ("in.pcd"), sample_, PcdKind::BINARY);
    succeed (arguments_);
    new_mesh_ = readFile ("out.ply");
    new_flat_mesh_ = readFile ("flat.vtk");
    writeFile ("out.ply", OLD);
    writeFile ("flat.vtk", OLD);
    std::filesystem::remove (path ("out.json"));
  }

  /// Lets all calls of this name fail, one after the other, and checks that no output is a part of
  /// a file.
  /// \return how many there are
  int forEachCall (const std::string& call, const std::string& kind,
                   const std::function<void (const Faulty&)>& check)
  {
    constexpr int MOST = 1000;
    for (int n = 0; n < MOST; ++n) {
      const std::string fault = call + ":" + std::to_string (n) + ":" + kind;
      SCOPED_TRACE (fault);
      writeFile ("out.ply", OLD);
      writeFile ("flat.vtk", OLD);
      std::filesystem::remove (path ("out.json"));
      Surroundings surroundings;
      surroundings.environment = {{"LD_PRELOAD", SYSTEM_FAULTS},
                                  {"PCL_FLOATER_FAULT", fault},
                                  {"PCL_FLOATER_FAULT_MARK", path ("mark")},
                                  {"PCL_FLOATER_FAULT_FILE", path ("in.pcd")}};
      Faulty faulty{run (arguments_, surroundings)};
      const bool has_happened = std::filesystem::remove (path ("mark"));
      const std::string mesh = readFile ("out.ply"), flat = readFile ("flat.vtk");
      faulty.is_new = mesh == new_mesh_;
      EXPECT_TRUE (faulty.is_new || mesh == OLD);
      EXPECT_TRUE (flat == OLD || flat == new_flat_mesh_);
      for (const std::string& name : names ()) {
        EXPECT_TRUE (name != "out.json" || Json::accept (readFile (name)));
        if (name.rfind (".pcl_floater.", 0) == 0) {
          faulty.has_rest = true;
          std::filesystem::remove (path (name));
        }
      }
      if (!has_happened) { // there are fewer such calls
        EXPECT_EQ (faulty.outcome.code, 0) << faulty.outcome.err;
        EXPECT_TRUE (faulty.is_new);
        return n;
      }
      check (faulty);
    }
    return MOST;
  }

  const Sample sample_ = makeSample (false);
  const std::vector<std::string> arguments_{
      "in.pcd", "out.ply", "--report", "out.json", "--parameterization", "flat.vtk"};
  std::string new_mesh_, new_flat_mesh_;
};

// Either all went well, or there is a message and all files are as they were.
TEST_F (SystemFaults, ErrorsAreToldOrDoNotMatter)
{
  int all = 0;
  for (const char* call : {"open", "read", "mmap", "fchmod", "write", "fsync"})
    for (const char* kind : {"EIO", "ENOSPC", "EACCES"})
      all += forEachCall (call, kind, [this] (const Faulty& faulty) {
        const Outcome& outcome = faulty.outcome;
        EXPECT_FALSE (faulty.has_rest);
        EXPECT_EQ (faulty.is_new, outcome.code == 0);
        if (outcome.code == 0)
          return;
        EXPECT_TRUE (outcome.code == INPUT_FAILED || outcome.code == OUTPUT_FAILED ||
                     outcome.code == INTERNAL_ERROR)
            << outcome.code << " " << outcome.err;
        EXPECT_THAT (outcome.err, HasSubstr ("pcl_floater_reconstruct: "));
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
    EXPECT_THAT (faulty.outcome.err, HasSubstr ("cannot write '"));
  });
  EXPECT_EQ (renames, 3);
}

TEST_F (SystemFaults, InterruptedAndShortWritesAreContinued)
{
  for (const auto& [call, kind] :
       {std::pair{"write", "EINTR"}, {"write", "short"}, {"fsync", "EINTR"}})
    EXPECT_GE (forEachCall (call, kind,
                            [] (const Faulty& faulty) {
                              EXPECT_EQ (faulty.outcome.code, 0) << faulty.outcome.err;
                              EXPECT_TRUE (faulty.is_new);
                              EXPECT_FALSE (faulty.has_rest);
                            }),
               3);
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
      if (faulty.outcome.code != 0) {
        EXPECT_EQ (faulty.outcome.code, INPUT_FAILED);
        EXPECT_THAT (faulty.outcome.err, HasSubstr ("truncated while it was in use"));
      }
      writePcd (path ("in.pcd"), sample_, PcdKind::BINARY);
    });
}

// Nobody reads what is printed: the run ends as programs in a pipe do, and leaves nothing.
TEST_F (SystemFaults, AClosedPipeLeavesNothing)
{
  Surroundings closed;
  closed.has_closed_pipe = true;
  EXPECT_EQ (run (arguments_, closed).code, -SIGPIPE);
  EXPECT_EQ (names (), (std::set<std::string>{"in.pcd", "out.ply", "flat.vtk"}));
  EXPECT_EQ (readFile ("out.ply"), OLD);
}

} // namespace
} // namespace pcl::floater
