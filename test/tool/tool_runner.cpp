// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_runner.h"

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

/// A word for the shell.
std::string
quoted (std::string word)
{
  const std::string quote = "'\\''";
  for (std::size_t at = 0; (at = word.find ('\'', at)) != std::string::npos; at += quote.size ())
    word.replace (at, 1, quote);
  return " '" + word + "'";
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

int
ToolTest::start (const std::vector<std::string>& arguments, const Surroundings& surroundings) const
{
  constexpr std::size_t BLOCK = 512, KILOBYTE = 1024; // units of ulimit
  const std::string &out = surroundings.standard_output, &err = surroundings.standard_error;
  std::string script = "cd" + quoted (folder_);
  if (surroundings.file_limit)
    script += " && ulimit -f " + std::to_string ((*surroundings.file_limit + BLOCK - 1) / BLOCK);
  if (surroundings.address_limit)
    script += " && ulimit -v " + std::to_string (*surroundings.address_limit / KILOBYTE);
  if (surroundings.standard_input.empty ())
    script += " && exec env";
  else
    script += " && cat" + quoted (surroundings.standard_input) + " | env";
  for (const auto& [variable, value] : surroundings.environment)
    script += quoted (variable + "=" + value);
  script += quoted (RECONSTRUCT_TOOL);
  for (const std::string& argument : arguments)
    script += quoted (argument);
  if (!surroundings.has_closed_pipe)
    script += " >" + quoted (out.empty () ? (logs_ / "out").string () : out);
  script += " 2>" + quoted (err.empty () ? (logs_ / "err").string () : err);

  const pid_t child = ::fork ();
  if (child != 0)
    return child;
  std::array<int, 2> ends{};
  if (!surroundings.has_closed_pipe ||
      (::pipe (ends.data ()) == 0 && ::dup2 (ends[1], STDOUT_FILENO) >= 0 &&
       ::close (ends[0]) == 0))
    ::execl ("/bin/sh", "sh", "-c", script.c_str (), nullptr);
  ::_exit (1);
}

Outcome
ToolTest::run (const std::vector<std::string>& arguments, const Surroundings& surroundings) const
{
  int status = 0;
  const pid_t child = start (arguments, surroundings);
  return ::waitpid (child, &status, 0) == child ? outcomeOf (status) : Outcome ();
}

Outcome
ToolTest::succeed (const std::vector<std::string>& arguments) const
{
  Outcome outcome = run (arguments);
  EXPECT_EQ (outcome.code, 0) << outcome.err;
  return outcome;
}

Json
ToolTest::report (std::vector<std::string> options, const std::string& input) const
{
  options.insert (options.begin (), {input, "out.ply", "--report", "out.json"});
  succeed (options);
  return Json::parse (readFile ("out.json"));
}

Outcome
ToolTest::interrupt (const std::vector<std::string>& arguments, int signal,
                     const std::function<bool (int)>& is_time) const
{
  const pid_t child = start (arguments, {});
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
  const int code = WIFEXITED (status) ? WEXITSTATUS (status) : -WTERMSIG (status);
  return {code, readWhole (logs_ / "out"), readWhole (logs_ / "err")};
}

void
ToolTest::expectFailure (const std::vector<std::string>& arguments, int code,
                         const std::string& cause, const Surroundings& surroundings) const
{
  SCOPED_TRACE (testing::PrintToString (arguments));
  const std::set<std::string> before = names ();
  const Outcome outcome = run (arguments, surroundings);
  EXPECT_EQ (outcome.code, code) << outcome.err;
  EXPECT_THAT (outcome.err, StartsWith ("pcl_floater_reconstruct: "));
  EXPECT_THAT (outcome.err, HasSubstr (cause));
  EXPECT_EQ (outcome.out, "");
  EXPECT_EQ (names (), before);
}

} // namespace pcl::floater
