// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The paths of a command line, looked at before the work begins.
#pragma once

#include "command_line.h"

namespace pcl::floater {
/// Checks all paths against each other and against the disk, before the work begins.
/// \throws UsageError if one file is named twice, WriteError if an output cannot be written,
/// ReadError if the extension of the input is unknown
void
checkPaths (const CommandLine& command_line);

} // namespace pcl::floater
