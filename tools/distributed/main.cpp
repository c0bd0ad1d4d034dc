// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reconstructs a surface of more points than one machine holds or can wait for: in blocks, on one
// or more processes of MPI, with all that is known on disk between the steps. What is finished is
// known by its file alone, so that a run that was ended goes on where it was.
#include "atomic_file.h"
#include "blas_threads.h"
#include "heap_reuse.h"
#include "job.h"
#include "memory_limit.h"
#include "messages.h"
#include "run_report.h"
#include "stored_mesh.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#endif

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
isFinished (FolderStore& folder, const std::string& name, const Plan& plan)
{
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
std::unique_ptr<MemoryLimit>
beginMemoryLimit (Job& job)
{
  if (job.line.max_memory == 0)
    return {};
  auto limit = std::make_unique<MemoryLimit> (job.line.max_memory, job.line.scratch);
  job.line.options.task_callback = [limit = limit.get ()] { limit->makeRoom (); };
  return limit;
}

// A process that is not the first.
int
workForOthers (const Job& job, FolderStore& folder, Processes& processes)
{
  RemoteStore remote (processes);
  Store& store = job.sends_files ? static_cast<Store&> (remote) : folder;
  const EffectiveOptions effective (job.line);
  const RunContext run (job.line.options.threads);
  const HeapReuse reuse (nullptr);
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
          blockStep ({store, *plan, effective.options, effective.limits, run}, order.text,
                     order.number);
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

// The workers, and where progress is printed.
struct Workers
{
  const Job& job;
  const StepContext& context;
  FolderStore& folder;
  Dealer* dealer;           // nullptr: this process does all
  const MemoryLimit* limit; // nullptr: there is none
  const Watch& watch;
};

void
sayDone (const Workers& workers, const std::string& step, std::size_t done, std::size_t before)
{
  say (workers.job, step + ": " + std::to_string (done) + " blocks done, " +
                        std::to_string (before) + " finished before, " + workers.watch.time ());
}

// Does a step for those blocks that are not finished.
void
workOn (const Workers& workers, const char* step)
{
  const StepContext& context = workers.context;
  const std::size_t count = context.plan.blocks;
  std::deque<std::size_t> left;
  for (std::size_t number = 0; number < count; ++number)
    if (!isFinished (workers.folder, blockFile (step, number), context.plan))
      left.push_back (number);
  const std::size_t finished = count - left.size ();
  {
    const HeapReuse reuse (workers.limit);
    if (workers.dealer != nullptr)
      workers.dealer->run (context, step, std::move (left));
    else
      for (const std::size_t number : left)
        blockStep (context, step, number);
  }
  sayDone (workers, step, count - finished, finished);
}

// Does all steps of the blocks.
void
workOnBlocks (const Workers& workers)
{
  const StepContext& context = workers.context;
  for (const char* step : BLOCK_STEPS) {
    workOn (workers, step);
    if (step == BLOCK_STEPS.front () && !isFinished (workers.folder, OUTLIERS, context.plan))
      chooseOutliersStep (context);
  }
}

int
workAlone (Job job, FolderStore& folder, Dealer* dealer)
{
  const Watch watch;
  prepareFolders (job);
  const std::unique_ptr<MemoryLimit> limit = beginMemoryLimit (job);
  if (!folder.has (MANIFEST))
    if (const int code = planStep (job, folder); code != EXIT_OK)
      return code;
  const Plan plan = readPlan (job, folder);
  openArrays (folder, POINTS, plan).verify ();
  say (job, "plan: " + std::to_string (plan.points) + " points in " + std::to_string (plan.blocks) +
                " blocks, " + watch.time ());
  const EffectiveOptions effective (job.line);
  const RunContext run (job.line.options.threads);
  const StepContext context{folder, plan, effective.options, effective.limits, run};
  const Workers workers{job, context, folder, dealer, limit.get (), watch};
  if (!areBlocksFreed (folder, plan))
    workOnBlocks (workers);
  if (!isFinished (folder, TRIANGLES, plan))
    if (const int code = joinStep (job, folder, plan); code != EXIT_OK)
      return code;
  say (job, "joined: " + watch.time ());
  const int code = writeStep (job, folder, plan);
  folder.finish ();
  say (job, "written: " + watch.time ());
  return code;
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
doStep (Job& job, FolderStore& folder, const std::string& step)
{
  if (step == "plan")
    prepareFolders (job);
  const std::unique_ptr<MemoryLimit> limit = beginMemoryLimit (job);
  if (step == "plan")
    return folder.has (MANIFEST) ? (readPlan (job, folder), static_cast<int> (EXIT_OK))
                                 : planStep (job, folder);
  const Plan plan = readPlan (job, folder);
  const EffectiveOptions effective (job.line);
  const RunContext run (job.line.options.threads);
  const StepContext context{folder, plan, effective.options, effective.limits, run};
  if (step == "outliers") {
    if (!isFinished (folder, OUTLIERS, plan))
      chooseOutliersStep (context);
    return EXIT_OK;
  }
  if (step == "join")
    return isFinished (folder, TRIANGLES, plan) ? static_cast<int> (EXIT_OK)
                                                : joinStep (job, folder, plan);
  if (step == "write")
    return writeStep (job, folder, plan);
  if (job.block >= plan.blocks)
    throw UsageError ("--block " + std::to_string (job.block) + ": there are only " +
                      std::to_string (plan.blocks) + " blocks, which are numbered from 0");
  const HeapReuse reuse (limit.get ());
  if (!isFinished (folder, blockFile (step.c_str (), job.block), plan))
    blockStep (context, step, job.block);
  return EXIT_OK;
}

/// Does all steps that are not finished. Called by every process of MPI_COMM_WORLD with the same
/// job. Process 0 does the steps of the whole cloud, deals out blocks, and works on some itself;
/// without MPI, it does all.
/// \return the exit code of all processes
int
runAll (const Job& job, FolderStore& folder)
{
  useOneHeap (); // MPI has threads
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

int
runStep (Job job, FolderStore& folder, const std::string& step)
{
  const int code = doStep (job, folder, step);
  folder.finish ();
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
  const auto print = [&command] (const char* step) {
    std::printf ("%s%s\n\n", command.c_str (), step);
  };
  const auto printAll = [&command] (const char* step, std::size_t count) {
    for (std::size_t number = 0; number < count; ++number)
      std::printf ("%s%s --block %zu\n", command.c_str (), step, number);
    std::printf ("\n");
  };
  for (const char* step : BLOCK_STEPS) {
    printAll (step, plan.blocks);
    if (step == BLOCK_STEPS.front ())
      print ("outliers");
  }
  print ("join");
  std::printf ("%swrite\n", command.c_str ());
}

int
run (Job job)
{
  const bool is_single_step = !job.step.empty () || job.prints_steps;
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
  return job.step.empty () ? runAll (job, folder) : runStep (job, folder, job.step);
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
#ifdef __GLIBC__
  mallopt (M_MMAP_THRESHOLD,
           1 << 20); // large arrays go back to the system as soon as they are freed
#endif
  pcl::floater::endBlasThreads ();
  return pcl::floater::runTool ({argv + (argc > 0 ? 1 : 0), argv + argc});
}
