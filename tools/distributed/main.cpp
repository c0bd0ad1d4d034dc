// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reconstructs a surface of more points than one machine holds or can wait for: in blocks, on
// several processes, with all that is known on disk between the steps.
#include "atomic_file.h"
#include "blas_threads.h"
#include "driver.h"

#include <cstdio>
#include <cstdlib>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace pcl::floater {
namespace {
constexpr const char* PROGRAM = "pcl_floater_distributed";

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
  try {
    handleSignals (EXIT_INPUT);
    Job job;
    if (const std::optional<int> done = parseJob (arguments, job))
      return *done;
    return run (std::move (job));
  }
  catch (const WorkError& error) {
    return fail (PROGRAM, EXIT_WORK, error.what ());
  }
  catch (...) {
    return failByException (PROGRAM, "use more blocks, or a machine with more");
  }
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
