// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How the tools that reconstruct end.
#pragma once

#include <stdexcept>
#include <string>

namespace pcl::floater {
/// Exit codes, as documented in --help.
enum ExitCode
{
  EXIT_OK = 0,
  EXIT_USAGE = 1,
  EXIT_INPUT = 2,
  EXIT_RECONSTRUCTION = 3,
  EXIT_OUTPUT = 4,
  EXIT_INTERNAL = 5,
  EXIT_WARNINGS = 6
};

/// The command line is wrong, or asks for something impossible.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Prints "program: message" to standard error.
/// \return the code
int
fail (const char* program, int code, const std::string& message);

/// Tells the exception that is being handled, by fail. To be called in a catch block.
/// \param if_no_memory what to do where memory was not enough
/// \return the exit code of it
int
failByException (const char* program, const char* if_no_memory);

} // namespace pcl::floater
