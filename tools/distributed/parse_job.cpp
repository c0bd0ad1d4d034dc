// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "job.h"
#include "option_table.h"
#include "options/check_options.h"

namespace pcl::floater {
namespace {
const char* const DESCRIPTION =
    "Reconstructs a surface from one or many files of points, in blocks, on any number of "
    "processes:\n"
    "the same mesh as pcl_floater_reconstruct makes of all points together. What is known after a\n"
    "step is in a work folder, so that a run that was ended goes on where it was.\n";

const char* const FOOTER =
    R"(Examples:
  mpirun -n 16 pcl_floater_distributed --work /shared/town tiles/*.las town.ply
  mpirun -n 16 pcl_floater_distributed --work /shared/town --tiles tiles/*.las town
  pcl_floater_distributed --work town --step plan tiles/*.las town.ply
  pcl_floater_distributed --work town --print-steps
  pcl_floater_distributed --work town --step stars --block 7

Notes:
  All processes need the work folder, on a file system that they share; with --exchange messages,
  only the first one needs it. The first one also reads the files of points and writes the mesh.
  --print-steps lists the commands that are left to others, such as a Slurm array: all commands up
  to an empty line may run at the same time. They take the options of the plan from its manifest.
  A step whose files are there is not done again. The work folder stays when the mesh is written;
  delete it then. For another cloud, other options or another number of blocks, take another one.

Exit codes:
  0  success
  1  usage: an option is unknown, malformed, out of its range, or not for this input
  2  the input cannot be read: missing, truncated, damaged, without x y z
  3  the cloud cannot be reconstructed; the message names the status
  4  an output or a file of the work folder cannot be written; no mesh is changed
  5  out of memory, or an internal error
  7  a file of the work folder is missing, damaged, of another version, or of another plan
)";

void
addSteps (CLI::App& app, Job& job)
{
  const std::string group = "Steps";
  addPath (app, "--work", job.work,
           "folder for what is known between the steps; it is made if it does not exist", group,
           "FOLDER");
  addNumber (app, "--blocks", job.blocks,
             "blocks into which the points are cut; 0: of half a million points each; the result "
             "is the same",
             group);
  std::vector<std::string> names;
  std::string of_blocks, of_all;
  for (const Step& step : STEPS) {
    names.emplace_back (step.name);
    (step.of_block != nullptr ? of_blocks : of_all) += std::string (", ") + step.name;
  }
  const auto choose = [&job, names] (const std::string& word) {
    job.step = findStep (word);
    return job.step != nullptr ? "" : "is no step" + didYouMean (word, names);
  };
  addParsed (app, "--step", choose,
             "do this step only: " + of_all.substr (2) +
                 "; or for a block: " + of_blocks.substr (2),
             "NAME (all)", group);
  addNumber (app, "--block", job.block, "block of the step, from 0", group)->option_text ("N");
  app.add_flag ("--print-steps", job.prints_steps,
                "print the commands of all steps after the plan, and exit")
      ->group (group);
  constexpr Choices<bool, 2> EXCHANGE_CHOICES{{{"files", false}, {"messages", true}}};
  addChoice (app, "--exchange", job.sends_files, EXCHANGE_CHOICES,
             "how processes get what others have found: from files in the work folder, or by "
             "messages of the first one",
             group);
  app.add_flag ("--free-disk", job.frees_disk,
                "remove the files of the blocks when join has made the mesh")
      ->group (group);
}

void
addGeneral (CLI::App& app, Job& job)
{
  const std::string general = "General";
  addNumber (app, "-j,--threads", job.line.options.threads,
             "threads of each process for its blocks, 0: one for each core; the result is the same",
             general);
  addNumber (
      app, "--join-threads", job.join_threads,
      "threads of the steps of the whole cloud, 0: one for each core; the result is the same",
      general);
  addLimitAndCoordinates (app, job.line);
  app.add_flag ("-q,--quiet", job.line.quiet, "print errors only")->group (general);
}

void
addFiles (CLI::App& app, std::vector<std::string>& files, Job& job)
{
  app.add_option ("FILES", files,
                  std::string ("point clouds: ") + CLOUD_EXTENSIONS +
                      "; then the mesh to write: " + MESH_EXTENSIONS + "; with --tiles a folder")
      ->option_text (" ");
  app.add_flag ("--tiles", job.writes_tiles,
                "write the mesh as a folder of .ply files: one for each file of points, or of a "
                "single one for each block; and tiles.json, which tells what they share")
      ->group ("More output");
  addOutputs (app, job.line);
}

void
takeFiles (const std::vector<std::string>& files, Job& job)
{
  if (files.size () < 2)
    throw UsageError ("give one or more files of points, and then that of the mesh");
  job.inputs.assign (files.begin (), files.end () - 1);
  job.line.output = files.back ();
  job.line.input = job.inputs.front ();
  for (const std::filesystem::path& input : job.inputs) {
    if (isStandardStream (input))
      throw UsageError ("the points cannot come from the standard input: they are read twice");
    if (cloudFormatOf (input) == nullptr)
      throw ReadError ("cannot read " + inputName (input) + ": its extension is unknown; use " +
                       CLOUD_EXTENSIONS);
  }
  if (job.writes_tiles) {
    if (!job.line.output.has_filename ()) // "town/"
      job.line.output = job.line.output.parent_path ();
    job.line.output_format = MeshFormat::PLY;
  }
  if (isStandardStream (job.line.output) || !job.line.meshFormat ())
    throw WriteError ("cannot write '" + job.line.output.string () +
                      "': it has no extension that tells the format of a mesh; use " +
                      MESH_EXTENSIONS + ", or --tiles and a folder");
}

} // namespace

std::optional<int>
parseJob (const std::vector<std::string>& arguments, Job& job)
{
  job.line.options.threads = 1;
  job.line.program = "pcl_floater_distributed";
  CLI::App app ("", job.line.program);
  std::vector<std::string> files;
  prepareApp (app, DESCRIPTION, FOOTER);
  addSteps (app, job);
  addGeneral (app, job);
  addTableOptions (app, job.line, [] (const OptionRow& row) {
    const std::string name = row.name;
    return row.group == std::string (option_group::SURFACE) || name == "neighbors" ||
           name == "sheet_filter";
  });
  addFiles (app, files, job);
  if (const std::optional<int> done = parseArguments (app, arguments))
    return done;
  job.has_block = app.count ("--block") > 0;
  job.arguments = arguments;
  if (job.work.string ().find_first_of ("\n\r") != std::string::npos)
    throw UsageError ("--work: the name has a line break in it; choose another one");
  if (job.work.empty ())
    throw UsageError ("--work is missing: name a folder for what is known between the steps");
  if (const Problem problem = checkOptions (job.line.options))
    throw UsageError (rangeMessage (app, problem));
  if (job.prints_steps && job.step != nullptr)
    throw UsageError ("--print-steps and --step exclude each other");
  if ((job.step != nullptr && job.step->of_block != nullptr) != job.has_block)
    throw UsageError (job.has_block
                          ? std::string ("--block is for a --step that is done for each block")
                          : std::string ("--step ") + job.step->name +
                                " is done for one block: give --block");
  const bool needs_files = job.step == nullptr ? !job.prints_steps : job.step->isPlan ();
  if (needs_files || !files.empty ())
    takeFiles (files, job);
  return std::nullopt;
}

} // namespace pcl::floater
