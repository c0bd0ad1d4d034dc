// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reconstructs a surface of more points than one machine holds or can wait for: in blocks, on one
// or more processes of MPI, with all that is known on disk between the steps. What is finished is
// known by its file alone, so that a run that was ended goes on where it was.
#include "atomic_file.h"
#include "blas_threads.h"
#include "heap.h"
#include "job.h"
#include "messages.h"
#include "run_report.h"
#include "scratch_arrays.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <functional>
#include <new>

namespace pcl::floater {
namespace {
constexpr const char* PROGRAM = "pcl_floater_distributed";

void
say (const Job& job, const std::string& text)
{
  if (!job.line.quiet)
    std::fprintf (stderr, "%s\n", text.c_str ());
}

bool
isFinished (FolderStore& folder, const Step& step, std::size_t block, const Plan& plan)
{
  if (step.kind == StepKind::WRITE) // is always done again
    return false;
  const std::string name = step.file != nullptr ? step.file : blockFile (step.name, block);
  if (!folder.has (name))
    return false;
  openArrays (folder, name, plan).verify ();
  return true;
}

// Calls work (), and makes of what it throws an exit code and a message.
template <typename Work>
int
guarded (Work&& work, std::string& message)
{
  try {
    return work ();
  }
  catch (const RemoteFailure& failure) {
    message = failure.what ();
    return failure.code ();
  }
  catch (const WorkError& error) {
    message = error.what ();
    return EXIT_WORK;
  }
  catch (...) {
    return describeException ("use more blocks, or a machine with more", message);
  }
}

int
tell (int code, const std::string& message)
{
  return message.empty () ? code : fail (PROGRAM, code, message);
}

// Limits the memory of this process, if that is asked for.
void
limitMemory (const Job& job)
{
  if (job.line.max_memory > 0)
    keepLargeArraysIn (job.line.scratch, job.line.max_memory);
}

// A process that is not the first.
int
workForOthers (const Job& job, FolderStore& folder, Processes& processes)
{
  RemoteStore remote (processes);
  Store& store = job.sends_files ? static_cast<Store&> (remote) : folder;
  std::optional<Plan> plan;
  for (;;) {
    processes.send (0, {});
    const Message order = processes.receive (0);
    if (order.topic == Topic::END) {
      folder.finish ();
      return static_cast<int> (order.number);
    }
    std::string message;
    const int code = guarded (
        [&] {
          if (!plan && !job.sends_files && !folder.has (MANIFEST))
            throw WorkError ("'" + folder.describe (MANIFEST) +
                             "' is not there for all processes; name a work folder that they "
                             "share, or use --exchange messages");
          if (!plan) {
            const std::unique_ptr<ByteSource> source = store.open (MANIFEST);
            std::string text (source->size (), '\0');
            source->read (0, text.size (), text.data ());
            plan = parseManifest (text, store.describe (MANIFEST));
          }
          findStep (order.text)
              ->of_block ({store, *plan, job.line, job.line.options.threads}, order.number);
          return static_cast<int> (EXIT_OK);
        },
        message);
    if (code == EXIT_OK)
      processes.send (0, {Topic::DONE});
    else
      processes.send (0, {Topic::FAIL, static_cast<std::uint64_t> (code), 0, message});
  }
}

// The time since it was made, as text.
class Watch
{
public:
  std::string time () const
  {
    constexpr std::size_t LONGEST = 32;
    std::array<char, LONGEST> text{};
    std::snprintf (text.data (), text.size (), "%.1f s", secondsSince (start_));
    return text.data ();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now ();
};

// Does a step for those blocks that are not finished, with all processes if there is a dealer.
void
workOnBlocks (const Step& step, const StepContext& context, FolderStore& folder, Dealer* dealer,
              const std::function<void (const std::string&)>& tellOf)
{
  std::deque<std::size_t> left;
  for (std::size_t block = 0; block < context.plan.blocks; ++block)
    if (!isFinished (folder, step, block, context.plan))
      left.push_back (block);
  const std::size_t count = left.size ();
  if (dealer != nullptr)
    dealer->run (context, step, std::move (left));
  else
    for (const std::size_t block : left)
      step.of_block (context, block);
  tellOf (std::string (step.name) + ": " + std::to_string (count) + " blocks done, " +
          std::to_string (context.plan.blocks - count) + " finished before");
}

// Does a step of the whole cloud that is not finished.
int
workOnAll (const Step& step, const Job& job, const StepContext& context, FolderStore& folder)
{
  if (step.kind == StepKind::JOIN)
    return joinStep (job, folder, context.plan);
  if (step.kind == StepKind::WRITE)
    return writeStep (job, folder, context.plan);
  chooseOutliersStep (context);
  return EXIT_OK;
}

int
workAlone (const Job& job, FolderStore& folder, Dealer* dealer)
{
  const Watch watch;
  const auto tellOf = [&] (const std::string& text) { say (job, text + ", " + watch.time ()); };
  prepareFolders (job);
  limitMemory (job);
  if (!folder.has (MANIFEST))
    if (const int code = planStep (job, folder); code != EXIT_OK)
      return code;
  const Plan plan = readPlan (job, folder);
  openArrays (folder, POINTS, plan).verify ();
  tellOf ("plan: " + std::to_string (plan.points) + " points in " + std::to_string (plan.blocks) +
          " blocks");
  const StepContext context (folder, plan, job.line, job.line.options.threads);
  const bool is_mesh_known = isFinished (folder, *findStep ("join"), 0, plan);
  for (const Step& step : STEPS) {
    if (step.kind == StepKind::PLAN || (is_mesh_known && step.kind != StepKind::WRITE))
      continue;
    if (step.kind == StepKind::OF_BLOCK) {
      workOnBlocks (step, context, folder, dealer, tellOf);
      continue;
    }
    if (!isFinished (folder, step, 0, plan))
      if (const int code = workOnAll (step, job, context, folder); code != EXIT_OK)
        return code;
    tellOf (step.name);
  }
  folder.finish ();
  return EXIT_OK;
}

int
runOnAll (const Job& job, FolderStore& folder, Processes& processes)
{
  if (processes.self () > 0) {
    std::string message;
    return tell (guarded ([&] { return workForOthers (job, folder, processes); }, message),
                 message);
  }
  std::string message;
  if (processes.count () == 1)
    return tell (guarded ([&] { return workAlone (job, folder, nullptr); }, message), message);
  Dealer dealer (processes, folder);
  const int code = guarded ([&] { return workAlone (job, folder, &dealer); }, message);
  tell (code, message);
  dealer.end (code);
  if (!job.line.quiet)
    std::fprintf (stderr, "messages: %.1f MB\n",
                  static_cast<double> (processes.exchangedBytes ()) / 1e6);
  return code;
}

int
doStep (const Job& job, FolderStore& folder)
{
  const Step& step = *job.step;
  if (step.kind == StepKind::PLAN)
    prepareFolders (job);
  limitMemory (job);
  if (step.kind == StepKind::PLAN && !folder.has (MANIFEST))
    return planStep (job, folder);
  const Plan plan = readPlan (job, folder);
  if (step.of_block != nullptr && job.block >= plan.blocks)
    throw UsageError ("--block " + std::to_string (job.block) + ": there are only " +
                      std::to_string (plan.blocks) + " blocks, which are numbered from 0");
  if (step.kind == StepKind::PLAN || isFinished (folder, step, job.block, plan))
    return EXIT_OK;
  const StepContext context (folder, plan, job.line, job.line.options.threads);
  if (step.of_block == nullptr)
    return workOnAll (step, job, context, folder);
  step.of_block (context, job.block);
  return EXIT_OK;
}

/// Does all steps that are not finished. Called by every process of MPI_COMM_WORLD with the same
/// job. Process 0 does the steps of the whole cloud, deals out blocks, and works on some itself;
/// without MPI, it does all.
/// \return the exit code of all processes
int
runAll (const Job& job, FolderStore& folder)
{
  int argc = 0;
  char** argv = nullptr;
  Processes processes (argc, argv);
  const int code = runOnAll (job, folder, processes);
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
    if (step.kind == StepKind::PLAN)
      continue;
    for (std::size_t block = 0; step.of_block != nullptr && block < plan.blocks; ++block)
      std::printf ("%s%s --block %zu\n", command.c_str (), step.name, block);
    if (step.of_block == nullptr)
      std::printf ("%s%s\n", command.c_str (), step.name);
    if (step.kind != StepKind::WRITE)
      std::printf ("\n");
  }
}

int
run (Job job)
{
  const bool is_single_step = job.step != nullptr || job.prints_steps;
  FolderStore folder (job.work);
  if (is_single_step && job.inputs.empty ()) {
    // The command line that made the plan; what belongs to this step comes from this one.
    const Plan plan = parseManifest (folder.readText (MANIFEST), folder.describe (MANIFEST));
    Job planned;
    parseJob (plan.arguments, planned);
    planned.work = job.work;
    planned.is_from_manifest = true;
    planned.step = job.step;
    planned.block = job.block;
    planned.prints_steps = job.prints_steps;
    planned.line.options.threads = job.line.options.threads;
    planned.join_threads = job.join_threads;
    planned.frees_disk = job.frees_disk;
    planned.line.max_memory = job.line.max_memory;
    planned.line.scratch = job.line.scratch;
    planned.line.quiet = job.line.quiet;
    job = std::move (planned);
  }
  if (job.line.scratch.empty ())
    job.line.scratch = job.work;
  if (job.prints_steps) {
    printSteps (job, folder);
    return EXIT_OK;
  }
  if (job.step == nullptr)
    return runAll (job, folder);
  const int code = doStep (job, folder);
  folder.finish ();
  return code;
}

int
runTool (const std::vector<std::string>& arguments)
{
  std::string message;
  const int code = guarded (
      [&arguments] {
        handleSignals (EXIT_INPUT);
        Job job;
        const std::optional<int> done = parseJob (arguments, job);
        return done ? *done : run (std::move (job));
      },
      message);
  return tell (code, message);
}

} // namespace
} // namespace pcl::floater

int
main (int argc, char** argv)
{
  pcl::floater::prepareHeap (true);
  pcl::floater::endBlasThreads ();
  return pcl::floater::runTool ({argv + (argc > 0 ? 1 : 0), argv + argc});
}
