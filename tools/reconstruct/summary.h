// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the tool prints at the end of a run.
#pragma once

#include "run_report.h"

namespace pcl::floater {
/// Prints errors and warnings to the standard error stream, the summary and the line of --json to
/// the standard output. Comes before any output file is visible: if nothing can be printed, no file
/// has been changed.
/// \throws WriteError if the standard output fails
void
printOutcome (const CommandLine& line, const Report& report, const RunFigures& figures);

} // namespace pcl::floater
