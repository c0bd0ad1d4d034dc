// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From a cloud of a file to the input of the core; and from its outcome to an exit code.
#pragma once

#include "cloud.h"
#include "command_line.h"
#include "format.h"
#include "run_report.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// Calls read (), and adds the name of the file to a ReadError.
template <typename Read>
auto
readNamed (const std::filesystem::path& path, Read&& read)
{
  try {
    return read ();
  }
  catch (const ReadError& error) {
    throw ReadError ("cannot read " + inputName (path) + ": " + error.what ());
  }
}

/// Copies the positions. The other fields of the cloud stay in its file until they are written.
Input
makeInput (const Cloud& cloud);

/// The normals of all points, for what the command line uses them.
/// \throws UsageError if the cloud has none
void
takeNormals (const CommandLine& line, const Cloud& cloud, Input& input);

/// Subtracts the origin that was asked for, from the viewpoints as well.
void
shiftOrigin (CommandLine& line, Cloud& cloud, Input& input);

/// The exit code of a run.
int
exitCode (const Report& report, const RunFigures& run);

} // namespace pcl::floater
