// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_runner.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace pcl::floater {
namespace {
std::string
readWhole (const std::filesystem::path& path)
{
  std::ifstream file (path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf ();
  return bytes.str ();
}

std::filesystem::path
makeFolder ()
{
  std::string name =
      (std::filesystem::temp_directory_path () / "pcl_floater_test.XXXXXX").string ();
  if (!::mkdtemp (name.data ()))
    throw std::runtime_error ("cannot make a temporary folder");
  return name;
}

/// Makes the standard input a pipe that another process writes a file into.
bool
pipeInto (const std::string& file)
{
  const std::string bytes = readWhole (file);
  std::array<int, 2> ends{};
  if (::pipe (ends.data ()) != 0)
    return false;
  const pid_t writer = ::fork ();
  if (writer == 0) {
    ::close (ends[0]);
    for (std::size_t done = 0; done < bytes.size ();) {
      const ssize_t put = ::write (ends[1], bytes.data () + done, bytes.size () - done);
      if (put <= 0)
        ::_exit (1);
      done += static_cast<std::size_t> (put);
    }
    ::_exit (0);
  }
  return writer > 0 && ::close (ends[1]) == 0 && ::dup2 (ends[0], STDIN_FILENO) >= 0 &&
         ::close (ends[0]) == 0;
}

/// In the child: never returns.
[[noreturn]] void
become (const std::vector<std::string>& arguments, const std::filesystem::path& folder,
        const std::filesystem::path& logs, const Surroundings& surroundings)
{
  std::vector<char*> argv;
  std::string tool = RECONSTRUCT_TOOL;
  argv.push_back (tool.data ());
  std::vector<std::string> copies = arguments;
  for (std::string& copy : copies)
    argv.push_back (copy.data ());
  argv.push_back (nullptr);
  const auto redirect = [] (const std::filesystem::path& name, int to) {
    const int file = ::open (name.c_str (), O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY, 0600);
    return file >= 0 && ::dup2 (file, to) >= 0;
  };
  const auto limitTo = [] (auto resource, const std::optional<std::size_t>& most) {
    const rlimit limit{most.value_or (0), most.value_or (0)};
    return !most || ::setrlimit (resource, &limit) == 0;
  };
  constexpr int NOT_STARTED = 127;
  const std::filesystem::path out = surroundings.standard_output.empty ()
                                        ? logs / "out"
                                        : std::filesystem::path (surroundings.standard_output);
  const std::filesystem::path err = surroundings.standard_error.empty ()
                                        ? logs / "err"
                                        : std::filesystem::path (surroundings.standard_error);
  if (!redirect (out, STDOUT_FILENO) || !redirect (err, STDERR_FILENO) ||
      ::chdir (folder.c_str ()) != 0 || !limitTo (RLIMIT_FSIZE, surroundings.file_limit) ||
      !limitTo (RLIMIT_AS, surroundings.address_limit))
    ::_exit (NOT_STARTED);
  if (!surroundings.standard_input.empty () && !pipeInto (surroundings.standard_input))
    ::_exit (NOT_STARTED);
  std::array<int, 2> ends{};
  if (surroundings.has_closed_pipe &&
      (::pipe (ends.data ()) != 0 || ::dup2 (ends[1], STDOUT_FILENO) < 0 || ::close (ends[0]) != 0))
    ::_exit (NOT_STARTED);
  for (const auto& [variable, value] : surroundings.environment)
    ::setenv (variable.c_str (), value.c_str (), 1);
  constexpr unsigned LONG_ENOUGH = 1500; // seconds, for what hangs
  if (surroundings.address_limit || !surroundings.environment.empty ())
    ::alarm (LONG_ENOUGH);
  ::execv (tool.c_str (), argv.data ());
  ::_exit (NOT_STARTED);
}

} // namespace

ToolTest::ToolTest () : folder_ (makeFolder ()), logs_ (makeFolder ()) {}

ToolTest::~ToolTest ()
{
  std::error_code ignored;
  std::filesystem::remove_all (folder_, ignored);
  std::filesystem::remove_all (logs_, ignored);
}

void
ToolTest::writeFile (const std::string& name, const std::string& bytes) const
{
  std::ofstream file (folder_ / name, std::ios::binary);
  file << bytes;
  ASSERT_TRUE (file.flush ()) << name;
}

std::string
ToolTest::readFile (const std::string& name) const
{
  return readWhole (folder_ / name);
}

std::set<std::string>
ToolTest::names () const
{
  std::set<std::string> result;
  for (const auto& entry : std::filesystem::directory_iterator (folder_))
    result.insert (entry.path ().filename ().string ());
  return result;
}

Outcome
ToolTest::run (const std::vector<std::string>& arguments,
               std::optional<std::size_t> file_limit) const
{
  Surroundings surroundings;
  surroundings.file_limit = file_limit;
  return runIn (surroundings, arguments);
}

Outcome
ToolTest::runIn (const Surroundings& surroundings, const std::vector<std::string>& arguments) const
{
  const pid_t child = ::fork ();
  if (child == 0)
    become (arguments, folder_, logs_, surroundings);
  int status = 0;
  return child > 0 && ::waitpid (child, &status, 0) == child ? outcomeOf (status) : Outcome ();
}

Outcome
ToolTest::interrupt (const std::vector<std::string>& arguments, int signal,
                     const std::function<bool (int)>& is_time) const
{
  const pid_t child = ::fork ();
  if (child == 0)
    become (arguments, folder_, logs_, {});
  if (child < 0)
    return {};
  int status = 0;
  pid_t ended = 0;
  while (ended == 0 && !is_time (child))
    ended = ::waitpid (child, &status, WNOHANG);
  if (ended == 0) {
    ::kill (child, signal);
    ended = ::waitpid (child, &status, 0);
  }
  return ended == child ? outcomeOf (status) : Outcome ();
}

Outcome
ToolTest::outcomeOf (int status) const
{
  Outcome outcome;
  if (WIFEXITED (status))
    outcome.code = WEXITSTATUS (status);
  else if (WIFSIGNALED (status))
    outcome.code = -WTERMSIG (status);
  outcome.out = readWhole (logs_ / "out");
  outcome.err = readWhole (logs_ / "err");
  return outcome;
}

void
ToolTest::expectFailure (const std::vector<std::string>& arguments, int code,
                         const std::string& cause, std::optional<std::size_t> file_limit) const
{
  const std::set<std::string> before = names ();
  const Outcome outcome = run (arguments, file_limit);
  EXPECT_EQ (outcome.code, code) << outcome.err;
  EXPECT_NE (outcome.err.find (cause), std::string::npos)
      << "no '" << cause << "' in: " << outcome.err;
  EXPECT_EQ (outcome.err.rfind ("pcl_floater_reconstruct: ", 0), 0U) << outcome.err;
  EXPECT_EQ (outcome.out, "");
  EXPECT_EQ (names (), before);
}

} // namespace pcl::floater
