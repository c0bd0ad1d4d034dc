// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a command line, in words of the user.
#pragma once

#include "core/problem.h"

#include <string>
#include <vector>

namespace CLI // NOLINT(readability-identifier-naming)
{
class App;
class ParseError;
} // namespace CLI

namespace pcl::floater {
/// "; did you mean a or b?" with the words that a mistyped one begins, or else those at the least
/// distance, of at most a third of the letters. Empty if there are none, or too many.
std::string
didYouMean (const std::string& word, const std::vector<std::string>& words);

/// The message for a command line that could not be parsed. Options are named as they were typed.
/// \param app that has refused it
/// \param arguments as they were typed
std::string
usageMessage (const CLI::App& app, const CLI::ParseError& error,
              const std::vector<std::string>& arguments);

/// The message for an option that is out of its range.
/// \param problem of checkOptions ()
std::string
rangeMessage (const CLI::App& app, const Problem& problem,
              const std::vector<std::string>& arguments);

} // namespace pcl::floater
