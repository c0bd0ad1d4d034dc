// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the real tool in a folder of its own, and in one with a cloud in it.
#pragma once

#include "files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pcl::floater {
using Json = nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr int USAGE = 1;
constexpr int INPUT_FAILED = 2;
constexpr int RECONSTRUCTION_FAILED = 3;
constexpr int OUTPUT_FAILED = 4;
constexpr int INTERNAL_ERROR = 5;
constexpr int REFUSED = 6;

// A sanitizer's own memory is resident, too.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool IS_SANITIZED = true;
#else
constexpr bool IS_SANITIZED = false;
#endif

/// How a run ended and what it printed.
struct Outcome
{
  int code = -1; ///< exit code; if a signal ended the run, minus its number
  std::string out;
  std::string err;
};

/// What a run finds around it, if that is unusual.
struct Surroundings
{
  std::optional<std::size_t> file_limit = {};    ///< largest size of a file in bytes
  std::optional<std::size_t> address_limit = {}; ///< bytes of addresses (RLIMIT_AS)
  std::string standard_output = {};              ///< takes it; empty: what is printed is kept
  std::string standard_input = {};               ///< is piped into it; empty: nothing is
  std::string standard_error = {};               ///< takes it, as standard_output
  bool has_closed_pipe = false;                  ///< nobody reads the standard output, a pipe
  std::vector<std::pair<std::string, std::string>> environment = {}; ///< variables and values
};

/// A test with a folder that is empty at the start and removed at the end.
class ToolTest : public testing::Test
{
protected:
  ToolTest ();
  ~ToolTest () override;

  /// Path of a file in the folder.
  std::string path (const std::string& name) const { return (folder_ / name).string (); }

  void writeFile (const std::string& name, const std::string& bytes) const;

  std::string readFile (const std::string& name) const;

  /// Names of everything in the folder, hidden files too.
  std::set<std::string> names () const;

  /// Runs the tool in the folder. What hangs is killed by the time limit of the test.
  Outcome run (const std::vector<std::string>& arguments,
               const Surroundings& surroundings = {}) const;

  /// Runs the tool, which must succeed.
  Outcome succeed (const std::vector<std::string>& arguments) const;

  /// Runs the tool, which must succeed.
  /// \return its report
  Json report (std::vector<std::string> options, const std::string& input = "in.pcd") const;

  /// Starts the tool and sends it a signal as soon as is_time (id of its process) returns true. It
  /// is called repeatedly until then, or until the tool ends by itself.
  Outcome interrupt (const std::vector<std::string>& arguments, int signal,
                     const std::function<bool (int)>& is_time) const;

  /// Runs the tool, which must end with `code`, name `cause` on the standard error stream, print
  /// nothing else, and leave the folder as it was.
  void expectFailure (const std::vector<std::string>& arguments, int code, const std::string& cause,
                      const Surroundings& surroundings = {}) const;

private:
  /// Starts the tool in the folder, by a shell that becomes the tool.
  /// \return its process
  int start (const std::vector<std::string>& arguments, const Surroundings& surroundings) const;

  /// \param status as from waitpid
  Outcome outcomeOf (int status) const;

  std::filesystem::path folder_;
  std::filesystem::path logs_; // beside the folder, so that names () does not see them
};

/// The same for parameterized tests.
template <typename T>
class ToolTestWith : public ToolTest, public testing::WithParamInterface<T>
{
};

/// With a cloud, in.pcd, and one on a line, from which no surface can be made.
class CommandLineTest : public ToolTest
{
protected:
  CommandLineTest ()
  {
    writeFile ("in.pcd", pcdText (sample_.points));
    writeFile ("line.pcd", pcdText ({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}));
  }

  Sample sample_ = makeSample (false);
};

} // namespace pcl::floater
