// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.h"

#include "memory_limit.h"
#include "option_kinds.h"
#include "option_table.h"
#include "options/check_options.h"
#include "options/option_rows.h"
#include "texture_output.h"
#include "usage_message.h"

#include <CLI/CLI.hpp>

namespace pcl::floater {
namespace {
/// \throws UsageError
void
checkMemoryLimit (CommandLine& line)
{
  if (line.max_memory == 0) {
    if (!line.scratch.empty ())
      throw UsageError ("--scratch is of no use without --max-memory");
    return;
  }
  // The solver allocates the factors of the linear system itself, and they are the larger part.
  if (line.options.topology == Topology::DISC)
    throw UsageError ("--max-memory cannot limit the memory for the linear system of a disc; use "
                      "it with --topology surface or auto, and without --loop and "
                      "--parameterization");
  if (line.scratch.empty ())
    line.scratch = line.output.has_parent_path () ? line.output.parent_path () : ".";
}

// Warns of options that were given, and that the method of TW 385 sets otherwise.
void
warnOfUnpublished (const CLI::App& app, const Options& given, const Options& effective,
                   std::vector<std::string>& warnings)
{
  std::string names;
  std::size_t count = 0;
  const OptionValues before (given), after (effective);
  for (std::size_t i = 0; i < before.rows.size (); ++i) {
    const std::string name = toolName (before.rows[i].name);
    if (before.values[i] != after.values[i] && app.count (name) > 0) {
      names += (count == 0 ? "" : ", ") + name;
      ++count;
    }
  }
  if (count > 0)
    warnings.push_back ((count == 1 ? "an option has no effect: " : "options have no effect: ") +
                        names + "; --method tw385 is that report and nothing else");
}

} // namespace

std::optional<int>
parseCommandLine (int argc, char** argv, CommandLine& command_line)
{
  CLI::App app ("", "pcl_floater_reconstruct");
  const std::vector<std::string> arguments (argv + (argc > 0 ? 1 : 0), argv + argc);
  addOptions (app, command_line);
  try {
    app.parse (argc, argv);
  }
  catch (const CLI::ParseError& error) {
    if (error.get_exit_code () == static_cast<int> (CLI::ExitCodes::Success))
      return app.exit (error);
    throw UsageError (usageMessage (app, error, arguments));
  }
  if (command_line.compute_normals && command_line.meshFormat () == MeshFormat::STL)
    command_line.warnings.emplace_back ("an option has no effect: --normals; STL has normals of "
                                        "triangles only, write .ply, .vtk or "
                                        ".obj");
  if (command_line.options.disc.as_published) {
    choosePublished (command_line.options.disc, app.count ("--boundary") > 0,
                     app.count ("--ordering") > 0);
    const Options given = command_line.options;
    command_line.options = effectiveOptions (given); // the report lists these
    warnOfUnpublished (app, given, command_line.options, command_line.warnings);
  }
  if (command_line.input.empty () || command_line.output.empty ())
    throw UsageError ("INPUT and OUTPUT are names of files; one of them is empty");
  const bool needs_disc = !command_line.loop.empty () || !command_line.parameterization.empty ();
  Topology& topology = command_line.options.topology;
  if (needs_disc && topology == Topology::SURFACE)
    throw UsageError ("--loop and --parameterization are for a disc, not for --topology surface");
  if (needs_disc)
    topology = Topology::DISC;
  if (const Problem problem = checkOptions (command_line.options))
    throw UsageError (rangeMessage (app, problem, arguments));
  command_line.texture_coordinates =
      command_line.texture_coordinates || !command_line.texture.empty ();
  checkTextureOptions (command_line);
  checkMemoryLimit (command_line);
  return std::nullopt;
}

} // namespace pcl::floater
