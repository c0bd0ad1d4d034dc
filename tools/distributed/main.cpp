// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reconstructs a surface of more points than one machine holds or can wait for: in blocks, on one
// or more processes of MPI, with all that is known on disk between the steps. What is finished is
// known by its file alone, so that a run that was ended goes on where it was.
#include "job.h"
#include "option_table.h"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <cstdio>

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
  All processes need the work folder, on a file system that they share. Only the first one reads the
  files of points and writes the mesh.
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
  beginGroup (app, "Steps");
  addPath (app, "--work", job.work,
           "folder for what is known between the steps; it is made if it does not exist", "FOLDER");
  addNumber (app, "--blocks", job.blocks,
             "blocks into which the points are cut; 0: of half a million points each; the result "
             "is the same");
  std::vector<std::string> names, of_blocks, of_all;
  for (const Step& step : STEPS) {
    names.emplace_back (step.name);
    (step.of_block != nullptr ? of_blocks : of_all).emplace_back (step.name);
  }
  const auto choose = [&job, names] (const std::string& word) {
    for (const Step& step : STEPS)
      if (word == step.name)
        job.step = &step;
    return job.step != nullptr ? "" : "is no step" + didYouMean (word, names);
  };
  addParsed (app, "--step", choose,
             "do this step only: " + boost::join (of_all, ", ") +
                 "; or for a block: " + boost::join (of_blocks, ", "),
             "NAME (all)");
  addNumber (app, "--block", job.block, "block of the step, from 0")->option_text ("N");
  app.add_flag ("--print-steps", job.prints_steps,
                "print the commands of all steps after the plan, and exit");
  app.add_flag ("--free-disk", job.frees_disk,
                "remove the files of the blocks when join has made the mesh");
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
    job.line.output_format = writePly;
  }
  if (isStandardStream (job.line.output) || job.line.meshFormat () == nullptr)
    throw WriteError ("cannot write '" + job.line.output.string () +
                      "': it has no extension that tells the format of a mesh; use " +
                      MESH_EXTENSIONS + ", or --tiles and a folder");
}

/// As parseCommandLine ().
std::optional<int>
parseJob (const std::vector<std::string>& arguments, Job& job)
{
  job.line.options.threads = 1;
  job.line.program = "pcl_floater_distributed";
  CLI::App app ("", job.line.program);
  std::vector<std::string> files;
  prepareApp (app, DESCRIPTION, FOOTER);
  addSteps (app, job);
  beginGroup (app, option_group::GENERAL);
  addNumber (
      app, "-j,--threads", job.line.options.threads,
      "threads of each process for its blocks, 0: one for each core; the result is the same");
  addNumber (
      app, "--join-threads", job.join_threads,
      "threads of the steps of the whole cloud, 0: one for each core; the result is the same");
  addLimitAndCoordinates (app, job.line);
  app.add_flag ("-q,--quiet", job.line.quiet, "print errors only");
  addTableOptions (app, job.line, [] (const OptionRow& row) {
    const std::string name = row.name;
    return row.group == std::string (option_group::SURFACE) || name == "neighbors" ||
           name == "sheet_filter";
  });
  app.add_option ("FILES", files,
                  std::string ("point clouds: ") + CLOUD_EXTENSIONS +
                      "; then the mesh to write: " + MESH_EXTENSIONS + "; with --tiles a folder")
      ->option_text (" ");
  beginGroup (app, "More output");
  app.add_flag ("--tiles", job.writes_tiles,
                "write the mesh as a folder of .ply files: one for each file of points, or of a "
                "single one for each block; and tiles.json, which tells what they share");
  addOutputs (app, job.line);
  if (const std::optional<int> done = parseArguments (app, arguments))
    return done;
  job.has_block = app.count ("--block") > 0;
  job.arguments = arguments;
  if (job.work.string ().find_first_of ("\n\r") != std::string::npos)
    throw UsageError ("--work: the name has a line break in it; choose another one");
  if (job.work.empty ())
    throw UsageError ("--work is missing: name a folder for what is known between the steps");
  requireOptions (app, job.line.options);
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

constexpr const char *PROGRAM = "pcl_floater_distributed",
                     *IF_NO_MEMORY = "use more blocks, or a machine with more";

/// The processes that work on a run. All calls of MPI are here.
class Processes : private boost::noncopyable
{
public:
  /// Threads that call no function of this may run.
  /// \param are_of_mpi else this process is the only one
  explicit Processes (bool are_of_mpi) : are_of_mpi_ (are_of_mpi)
  {
    if (!are_of_mpi)
      return;
    int provided = 0;
    MPI_Init_thread (nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank (MPI_COMM_WORLD, &self_);
    MPI_Comm_size (MPI_COMM_WORLD, &count_);
  }
  ~Processes ()
  {
    if (are_of_mpi_)
      MPI_Finalize ();
  }

  int self () const { return self_; } ///< from 0 on

  /// Whether this process works on a block.
  bool has (std::size_t block) const
  {
    return block % static_cast<std::size_t> (count_) == static_cast<std::size_t> (self_);
  }

  /// Waits for all processes, which takes no processor time.
  /// \return the sum or the largest of their numbers
  int combined (int number, MPI_Op operation) const
  {
    constexpr std::chrono::milliseconds BETWEEN_LOOKS{1};
    int all = number, is_done = are_of_mpi_ ? 0 : 1;
    MPI_Request request = MPI_REQUEST_NULL;
    if (are_of_mpi_)
      MPI_Iallreduce (&number, &all, 1, MPI_INT, operation, MPI_COMM_WORLD, &request);
    for (; is_done == 0; std::this_thread::sleep_for (BETWEEN_LOOKS))
      MPI_Test (&request, &is_done, MPI_STATUS_IGNORE);
    return all;
  }

private:
  bool are_of_mpi_;
  int self_ = 0, count_ = 1;
};

bool
isFinished (const Store& store, const Step& step, std::size_t block, const Plan& plan)
{
  if (step.of_all == writeStep) // is always done again
    return false;
  const std::string name = step.file != nullptr ? step.file : blockFile (step.name, block);
  if (!store.has (name))
    return false;
  store.arrays (name, plan).verify ();
  return true;
}

// Makes the work folder, and checks that all outputs can be written.
void
prepareFolders (const Job& job)
{
  std::error_code error;
  if (std::filesystem::create_directories (job.work, error))
    std::filesystem::permissions (job.work, std::filesystem::perms::owner_all, error);
  if (error || !std::filesystem::is_directory (job.work))
    throw WriteError ("cannot make the work folder '" + job.work.string () +
                      "': " + (error ? error.message () : "there is a file of that name"));
  requireWritable (job.work / MANIFEST);
  if (job.writes_tiles && std::filesystem::exists (job.line.output)) {
    if (std::filesystem::equivalent (job.line.output, job.work))
      throw UsageError ("the tiles cannot be in the work folder; name another folder");
    requireWritable (job.line.output / TILES);
  }
  else
    requireWritable (job.line.output);
  if (!job.line.report.empty ())
    requireWritable (job.line.report);
}

// Makes the plan if that is asked for and there is none. Reads it and compares it with the job, but
// for a step other than `join` that has all from the manifest.
int
findPlan (const Job& job, const Store& store, Plan& plan)
{
  const bool plans = job.step == nullptr || job.step->isPlan ();
  if (plans)
    prepareFolders (job);
  if (job.line.max_memory > 0)
    keepLargeArraysIn (job.line.scratch, job.line.max_memory);
  if (plans && !store.has (MANIFEST))
    if (const int code = planStep (job, store); code != EXIT_OK)
      return code;
  plan = readManifest (store);
  if (!job.is_from_manifest || (job.step != nullptr && job.step->of_all == joinStep))
    requirePlan (job, store, plan);
  if (job.has_block && job.block >= plan.blocks)
    throw UsageError ("--block " + std::to_string (job.block) + ": there are only " +
                      std::to_string (plan.blocks) + " blocks, which are numbered from 0");
  if (job.step == nullptr)
    store.arrays (POINTS, plan).verify ();
  return EXIT_OK;
}

/// Does all steps that are not finished, or the one that is asked for. Called by every process with
/// the same job. Process 0 does the steps of the whole cloud; the blocks are dealt out by number.
/// \return the exit code, the same for all processes
int
workOnSteps (const Job& job, const Store& store)
{
  const auto start = std::chrono::steady_clock::now ();
  const bool does_all = job.step == nullptr;
  const Processes processes (does_all);
  const bool is_first = processes.self () == 0;
  int code = EXIT_OK; // of all processes
  const auto tellOf = [&] (const std::string& text) {
    if (is_first && does_all && code == EXIT_OK && !job.line.quiet)
      std::fprintf (stderr, "%s, %.1f s\n", text.c_str (), secondsSince (start));
  };
  // Does the part of this process, and goes on when all have done theirs.
  const auto together = [&] (const std::function<int ()>& part) {
    if (code == EXIT_OK)
      code = processes.combined (guarded (PROGRAM, IF_NO_MEMORY, part), MPI_MAX);
  };
  Plan plan;
  bool is_mesh_known = false;
  together ([&] () -> int { return is_first ? findPlan (job, store, plan) : EXIT_OK; });
  tellOf ("plan: " + std::to_string (plan.points) + " points in " + std::to_string (plan.blocks) +
          " blocks");
  together ([&] () -> int {
    if (!store.has (MANIFEST))
      throw WorkError ("'" + store.path (MANIFEST).string () +
                       "' is not there for all processes; name a work folder that they share");
    if (!is_first)
      plan = readManifest (store);
    is_mesh_known = does_all && store.has (TRIANGLES);
    return EXIT_OK;
  });
  for (const Step& step : STEPS) {
    if (step.isPlan () || !(does_all || job.step == &step))
      continue;
    const bool is_left = !is_mesh_known || step.of_all == joinStep || step.of_all == writeStep;
    int done = 0;
    together ([&] () -> int {
      if (!is_left)
        return EXIT_OK;
      if (step.of_all != nullptr)
        return is_first && !isFinished (store, step, 0, plan) ? step.of_all (job, store, plan)
                                                              : EXIT_OK;
      const StepContext context{store, plan, job.line, job.line.options.threads};
      for (std::size_t block = 0; block < plan.blocks; ++block)
        if ((does_all ? processes.has (block) : block == job.block) &&
            !isFinished (store, step, block, plan)) {
          step.of_block (context, block);
          ++done;
        }
      return EXIT_OK;
    });
    done = processes.combined (done, MPI_SUM);
    if (is_left && step.of_all != nullptr)
      tellOf (step.name);
    else if (is_left)
      tellOf (std::string (step.name) + ": " + std::to_string (done) + " blocks done, " +
              std::to_string (plan.blocks - static_cast<std::size_t> (done)) + " finished before");
  }
  constexpr std::size_t MEGABYTE = 1'000'000;
  if (code == EXIT_OK && does_all && !job.line.quiet)
    std::fprintf (stderr, "process %d: peak memory %zu MB\n", processes.self (),
                  peakMemory () / MEGABYTE);
  return code;
}

/// Prints the commands of all steps, one in each line; steps between two empty lines may run at the
/// same time.
void
printSteps (const Job& job, const Store& store)
{
  const Plan plan = readManifest (store);
  // Quoted for a shell.
  const std::string work = boost::replace_all_copy (job.work.string (), "'", "'\\''");
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
  const Store store{job.work};
  if ((job.step != nullptr || job.prints_steps) && job.inputs.empty ()) {
    // The command line that made the plan; what belongs to this step comes from this one.
    Job planned;
    parseJob (readManifest (store).arguments, planned);
    planned.line.options.threads = job.line.options.threads;
    planned.line.max_memory = job.line.max_memory;
    planned.line.scratch = job.line.scratch;
    planned.line.quiet = job.line.quiet;
    job.line = planned.line;
    job.inputs = planned.inputs;
    job.blocks = planned.blocks;
    job.writes_tiles = planned.writes_tiles;
    job.is_from_manifest = true;
  }
  if (job.line.scratch.empty ())
    job.line.scratch = job.work;
  if (!job.prints_steps)
    return workOnSteps (job, store);
  printSteps (job, store);
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
