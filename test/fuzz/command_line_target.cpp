// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: each line of the bytes is an argument of the tool. Parsed and checked, not run.
#include "command_line.h"
#include "options/check_options.h"

#include "atomic_file.h"
#include "cloud.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {
// What the tool does before it reads a file.
void
parse (std::vector<std::string> words)
{
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back (word.data ());
  const auto count = static_cast<int> (arguments.size ());
  arguments.push_back (nullptr);
  pcl::floater::CommandLine line;
  if (const auto done = pcl::floater::parseCommandLine (count, arguments.data (), line)) {
    if (*done != pcl::floater::EXIT_OK) // help or version
      std::abort ();
    return;
  }
  if (line.input.empty () || line.output.empty () ||
      pcl::floater::checkOptions (line.options).status != pcl::floater::RunStatus::SUCCESS)
    std::abort ();
  pcl::floater::checkPaths (line);
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
  // The help is printed thousands of times.
  static const bool is_quiet = std::freopen ("/dev/null", "w", stdout) != nullptr;
  constexpr std::size_t LONGEST = 4096;
  if (!is_quiet || size > LONGEST)
    return 0;
  std::vector<std::string> words{"pcl_floater_reconstruct"};
  std::string word;
  for (std::size_t i = 0; i <= size; ++i) {
    if (i < size && data[i] != '\n' && data[i] != '\0') {
      word.push_back (static_cast<char> (data[i]));
      continue;
    }
    words.push_back (std::move (word));
    word.clear ();
  }
  try {
    parse (std::move (words));
  }
  catch (const pcl::floater::UsageError& error) {
    if (*error.what () == '\0')
      std::abort ();
  }
  catch (const pcl::floater::ReadError&) { // the extension of the input
  }
  catch (const pcl::floater::WriteError&) { // an output that could not be made
  }
  return 0;
}
