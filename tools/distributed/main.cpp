// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reconstructs a surface of more points than one machine holds or can wait for: in blocks, on one
// or more processes of MPI, with all that is known on disk between the steps. What is finished is
// known by its file alone, so that a run that was ended goes on where it was.
#include "heap.h"
#include "job.h"
#include "messages.h"
#include "scratch_arrays.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <utility>

namespace pcl::floater {
namespace {
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
  std::array<char, 64> text{};
  if (is_first && has_others) {
    dealer.end (code);
    std::snprintf (text.data (), text.size (), "messages: %.1f MB",
                   static_cast<double> (processes.exchangedBytes ()) / 1e6);
    say (job, text.data ());
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
