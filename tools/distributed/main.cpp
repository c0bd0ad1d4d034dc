// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reconstructs a surface of more points than one machine holds or can wait for: in blocks, on one
// or more processes of MPI, with all that is known on disk between the steps. What is finished is
// known by its file alone, so that a run that was ended goes on where it was.
#include "job.h"
#include "messages.h"
#include "option_table.h"
#include "options/check_options.h"
#include "scratch_arrays.h"

#include <chrono>
#include <cstdio>
#include <utility>

namespace pcl::floater {
namespace {
const char* const DESCRIPTION =
    R"(Reconstructs a surface from one or many files of points, in blocks, on any number of processes:
the same mesh as pcl_floater_reconstruct makes of all points together. What is known after a
step is in a work folder, so that a run that was ended goes on where it was.
)";

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

/// The step of this name; nullptr if there is none.
const Step*
findStep (const std::string& name)
{
  const auto* const step = std::find_if (
      STEPS.begin (), STEPS.end (), [&name] (const Step& known) { return name == known.name; });
  return step == STEPS.end () ? nullptr : step;
}

void
addSteps (CLI::App& app, Job& job)
{
  beginGroup (app, "Steps");
  addPath (app, "--work", job.work,
           "folder for what is known between the steps; it is made if it does not exist", "FOLDER");
  addNumber (app, "--blocks", job.blocks,
             "blocks into which the points are cut; 0: of half a million points each; the result "
             "is the same");
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
             "NAME (all)");
  addNumber (app, "--block", job.block, "block of the step, from 0")->option_text ("N");
  app.add_flag ("--print-steps", job.prints_steps,
                "print the commands of all steps after the plan, and exit");
  constexpr Choices<bool, 2> EXCHANGE_CHOICES{{{"files", false}, {"messages", true}}};
  addChoice (app, "--exchange", job.sends_files, EXCHANGE_CHOICES,
             "how processes get what others have found: from files in the work folder, or by "
             "messages of the first one");
  app.add_flag ("--free-disk", job.frees_disk,
                "remove the files of the blocks when join has made the mesh");
}

void
addGeneral (CLI::App& app, Job& job)
{
  beginGroup (app, option_group::GENERAL);
  addNumber (
      app, "-j,--threads", job.line.options.threads,
      "threads of each process for its blocks, 0: one for each core; the result is the same");
  addNumber (
      app, "--join-threads", job.join_threads,
      "threads of the steps of the whole cloud, 0: one for each core; the result is the same");
  addLimitAndCoordinates (app, job.line);
  app.add_flag ("-q,--quiet", job.line.quiet, "print errors only");
}

void
addFiles (CLI::App& app, std::vector<std::string>& files, Job& job)
{
  app.add_option ("FILES", files,
                  std::string ("point clouds: ") + CLOUD_EXTENSIONS +
                      "; then the mesh to write: " + MESH_EXTENSIONS + "; with --tiles a folder")
      ->option_text (" ");
  beginGroup (app, "More output");
  app.add_flag ("--tiles", job.writes_tiles,
                "write the mesh as a folder of .ply files: one for each file of points, or of a "
                "single one for each block; and tiles.json, which tells what they share");
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

/// Parses the command line. Prints the help or the version if asked for.
/// \return the exit code if there is nothing else to do
/// \throws UsageError
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

void
say (const Job& job, const std::string& text)
{
  if (!job.line.quiet)
    std::fprintf (stderr, "%s\n", text.c_str ());
}

bool
isFinished (FolderStore& folder, const Step& step, std::size_t block, const Plan& plan)
{
  if (step.of_all == writeStep) // is always done again
    return false;
  const std::string name = step.file != nullptr ? step.file : blockFile (step.name, block);
  if (!folder.has (name))
    return false;
  openArrays (folder, name, plan).verify ();
  return true;
}

constexpr const char *PROGRAM = "pcl_floater_distributed",
                     *IF_NO_MEMORY = "use more blocks, or a machine with more";

// A process that is not the first.
int
workForOthers (const Job& job, FolderStore& folder, Processes& processes)
{
  RemoteStore remote (processes);
  Store& store = job.sends_files ? static_cast<Store&> (remote) : folder;
  std::optional<Plan> plan;
  Message outcome;
  for (;;) {
    const Message order = processes.ask (outcome);
    if (order.topic == Topic::END)
      return static_cast<int> (order.number);
    outcome.count = 1;
    outcome.number = static_cast<std::uint64_t> (guarded (
        PROGRAM, IF_NO_MEMORY,
        [&] {
          if (!plan && !job.sends_files && !folder.has (MANIFEST))
            throw WorkError ("'" + folder.describe (MANIFEST) +
                             "' is not there for all processes; name a work folder that they "
                             "share, or use --exchange messages");
          if (!plan)
            plan = parseManifest (store.open (MANIFEST).text (), store.describe (MANIFEST));
          const StepContext context (store, *plan, job.line, job.line.options.threads);
          findStep (order.text)->of_block (context, order.number);
          return static_cast<int> (EXIT_OK);
        },
        &outcome.text));
  }
}

// Does all steps that are not finished, or the one that is asked for.
// \param dealer nullptr: there are no other processes
int
workOnSteps (const Job& job, FolderStore& folder, Dealer* dealer)
{
  const auto start = std::chrono::steady_clock::now ();
  const bool does_all = job.step == nullptr;
  const auto tellOf = [&] (const std::string& text) {
    if (does_all && !job.line.quiet)
      std::fprintf (stderr, "%s, %.1f s\n", text.c_str (), secondsSince (start));
  };
  const bool plans = does_all || job.step->isPlan ();
  if (plans)
    prepareFolders (job);
  if (job.line.max_memory > 0)
    keepLargeArraysIn (job.line.scratch, job.line.max_memory);
  if (plans && !folder.has (MANIFEST))
    if (const int code = planStep (job, folder); code != EXIT_OK || !does_all)
      return code;
  const Plan plan = readPlan (job, folder);
  if (job.has_block && job.block >= plan.blocks)
    throw UsageError ("--block " + std::to_string (job.block) + ": there are only " +
                      std::to_string (plan.blocks) + " blocks, which are numbered from 0");
  if (does_all)
    openArrays (folder, POINTS, plan).verify ();
  tellOf ("plan: " + std::to_string (plan.points) + " points in " + std::to_string (plan.blocks) +
          " blocks");
  const StepContext context (folder, plan, job.line, job.line.options.threads);
  const bool is_mesh_known = does_all && isFinished (folder, *findStep ("join"), 0, plan);
  for (const Step& step : STEPS) {
    if (step.isPlan () || !(does_all || job.step == &step) ||
        (is_mesh_known && step.of_all != writeStep))
      continue;
    if (step.of_block == nullptr) {
      if (!isFinished (folder, step, 0, plan))
        if (const int code = step.of_all (job, folder, plan); code != EXIT_OK)
          return code;
      tellOf (step.name);
      continue;
    }
    std::vector<std::size_t> left;
    for (std::size_t block = 0; block < plan.blocks; ++block)
      if ((does_all || block == job.block) && !isFinished (folder, step, block, plan))
        left.push_back (block);
    if (dealer != nullptr)
      dealer->run (context, step, left);
    else
      for (const std::size_t block : left)
        step.of_block (context, block);
    tellOf (std::string (step.name) + ": " + std::to_string (left.size ()) + " blocks done, " +
            std::to_string (plan.blocks - left.size ()) + " finished before");
  }
  return EXIT_OK;
}

/// Does all steps that are not finished. Called by every process of MPI_COMM_WORLD with the same
/// job. Process 0 does the steps of the whole cloud, deals out blocks, and works on some itself;
/// without MPI, it does all.
/// \return the exit code of all processes
int
runAll (const Job& job, FolderStore& folder)
{
  Processes processes;
  Dealer dealer (processes, folder);
  const bool is_first = processes.self () == 0, has_others = processes.count () > 1;
  const int code = guarded (PROGRAM, IF_NO_MEMORY, [&] {
    return is_first ? workOnSteps (job, folder, has_others ? &dealer : nullptr)
                    : workForOthers (job, folder, processes);
  });
  if (is_first && has_others) {
    dealer.end (code);
    if (!job.line.quiet)
      std::fprintf (stderr, "messages: %.1f MB\n",
                    static_cast<double> (processes.exchangedBytes ()) / 1e6);
  }
  constexpr std::size_t MEGABYTE = 1'000'000;
  if (code == EXIT_OK)
    say (job, "process " + std::to_string (processes.self ()) + ": peak memory " +
                  std::to_string (peakMemory () / MEGABYTE) + " MB");
  return code;
}

/// Prints the commands of all steps, one in each line; steps between two empty lines may run at the
/// same time.
void
printSteps (const Job& job, FolderStore& folder)
{
  const Plan plan = readPlan (job, folder);
  std::string work; // quoted for a shell
  for (const char c : job.work.string ())
    work += c == '\'' ? "'\\''" : std::string (1, c);
  const std::string command = "pcl_floater_distributed --work '" + work + "' --step ";
  for (const Step& step : STEPS) {
    if (step.isPlan ())
      continue;
    for (std::size_t block = 0; step.of_block != nullptr && block < plan.blocks; ++block)
      std::printf ("%s%s --block %zu\n", command.c_str (), step.name, block);
    if (step.of_block == nullptr)
      std::printf ("%s%s\n", command.c_str (), step.name);
    if (step.of_all != writeStep)
      std::printf ("\n");
  }
}

int
run (Job job)
{
  FolderStore folder (job.work);
  if ((job.step != nullptr || job.prints_steps) && job.inputs.empty ()) {
    // The command line that made the plan; what belongs to this step comes from this one.
    Job planned;
    parseJob (parseManifest (folder.open (MANIFEST).text (), folder.describe (MANIFEST)).arguments,
              planned);
    planned.line.options.threads = job.line.options.threads;
    planned.line.max_memory = job.line.max_memory;
    planned.line.scratch = job.line.scratch;
    planned.line.quiet = job.line.quiet;
    job.line = planned.line;
    job.inputs = planned.inputs;
    job.arguments = planned.arguments;
    job.blocks = planned.blocks;
    job.writes_tiles = planned.writes_tiles;
    job.is_from_manifest = true;
  }
  if (job.line.scratch.empty ())
    job.line.scratch = job.work;
  if (!job.prints_steps)
    return job.step == nullptr ? runAll (job, folder) : workOnSteps (job, folder, nullptr);
  printSteps (job, folder);
  return EXIT_OK;
}

} // namespace
} // namespace pcl::floater

int
main (int argc, char** argv)
{
  using namespace pcl::floater;
  prepareHeap (true);
  endBlasThreads ();
  return guarded (PROGRAM, IF_NO_MEMORY, [&] {
    handleSignals (EXIT_INPUT);
    Job job;
    const std::optional<int> done = parseJob ({argv + (argc > 0 ? 1 : 0), argv + argc}, job);
    return done ? *done : run (std::move (job));
  });
}
