// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// All options of the tool, in the groups of its help.
#pragma once

#include "command_line.h"

#include <functional>

namespace CLI // NOLINT(readability-identifier-naming)
{
class App;
}

namespace pcl::floater {
struct OptionRow;

/// Adds every option, the two positional arguments and the text around them to \a app, which writes
/// to \a line when it parses, and so has to end before it.
void
addOptions (CLI::App& app, CommandLine& line);

/// The rows of the table of options that the tool takes, and --use-input-normals.
void
addTableOptions (CLI::App& app, CommandLine& line,
                 const std::function<bool (const OptionRow&)>& takes);

/// --max-memory and --scratch.
void
addMemoryLimit (CLI::App& app, CommandLine& line);

/// --limit, which the help does not show.
void
addLimit (CLI::App& app, CommandLine& line);

/// --shift and --precision.
void
addCoordinates (CLI::App& app, CommandLine& line);

} // namespace pcl::floater
