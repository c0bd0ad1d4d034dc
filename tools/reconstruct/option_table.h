// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// All options of the tool, in the groups of its help.
#pragma once

#include "command_line.h"

namespace CLI // NOLINT(readability-identifier-naming)
{
class App;
}

namespace pcl::floater {
/// Adds every option, the two positional arguments and the text around them to \a app, which writes
/// to \a line when it parses, and so has to end before it.
void
addOptions (CLI::App& app, CommandLine& line);

/// Those on surfaces that are no disc, but for what the points are taken for.
void
addSurfaceOptions (CLI::App& app, CommandLine& line);

/// --neighbors.
void
addNeighborCount (CLI::App& app, CommandLine& line);

/// --use-input-normals and --sheet-filter.
void
addTangentPlaneOptions (CLI::App& app, CommandLine& line);

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
