// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the real tool in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pcl::floater {
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
  std::optional<std::size_t> file_limit;    ///< largest size of a file in bytes (RLIMIT_FSIZE)
  std::optional<std::size_t> address_limit; ///< bytes of addresses (RLIMIT_AS)
  std::string standard_output;              ///< file that takes it; empty: what is printed is kept
  std::string standard_input;               ///< file that is piped into it; empty: nothing is
  std::string standard_error;               ///< file or terminal that takes it, as standard_output
  bool has_closed_pipe = false;             ///< the standard output is a pipe that nobody reads
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

  /// Runs the tool in the folder.
  /// \param file_limit largest size of a file in bytes (RLIMIT_FSIZE)
  Outcome run (const std::vector<std::string>& arguments,
               std::optional<std::size_t> file_limit = std::nullopt) const;

  /// Runs the tool in the folder. A run that does not end is killed after a minute (SIGALRM).
  Outcome runIn (const Surroundings& surroundings, const std::vector<std::string>& arguments) const;

  /// Starts the tool and sends it a signal as soon as is_time (id of its process) returns true. It
  /// is called repeatedly until then, or until the tool ends by itself.
  Outcome interrupt (const std::vector<std::string>& arguments, int signal,
                     const std::function<bool (int)>& is_time) const;

  /// Runs the tool, which must end with `code`, name `cause` on the standard error stream, print
  /// nothing else, and leave the folder as it was.
  void expectFailure (const std::vector<std::string>& arguments, int code, const std::string& cause,
                      std::optional<std::size_t> file_limit = std::nullopt) const;

private:
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

} // namespace pcl::floater
