// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked for, and the steps that are done once for the whole cloud.
#pragma once

#include "block_steps.h"
#include "command_line.h"
#include "plan.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl::floater {
/// Exit code if a file of the work folder cannot be used.
constexpr int EXIT_WORK = 7;

/// What the user asked for.
struct Job
{
  CommandLine line; ///< options of the reconstruction, and OUTPUT
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> arguments; ///< as they were typed
  std::filesystem::path work;
  const Step* step = nullptr; ///< nullptr: all
  std::size_t block = 0;      ///< of the step
  bool has_block = false;     ///< it was given
  std::size_t blocks = 0;     ///< 0: chosen by the number of points
  int join_threads = 0;       ///< 0: all cores
  bool sends_files = false;   ///< --exchange messages
  bool writes_tiles = false;  ///< OUTPUT is a folder
  bool frees_disk = false;    ///< files of blocks go when the mesh is known
  bool prints_steps = false;
  bool is_from_manifest = false; ///< files and options are those of the manifest
};

/// Parses the command line. Prints the help or the version if asked for.
/// \return the exit code if there is nothing else to do
/// \throws UsageError
std::optional<int>
parseJob (const std::vector<std::string>& arguments, Job& job);

/// Makes the work folder, and checks that all outputs can be written.
/// \throws WriteError
void
prepareFolders (const Job& job);

/// Reads the cloud, sorts its points along the curve and writes them and the manifest.
/// \return EXIT_OK, or the exit code of what is wrong with the cloud, which has been printed
int
planStep (const Job& job, FolderStore& store);

/// Reads the manifest. Compares it with the parameters of the job and with all bytes of its files, but
/// for a step other than `join` that has all from the manifest.
/// \throws WorkError if they are others
Plan
readPlan (const Job& job, FolderStore& store);

} // namespace pcl::floater
