// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Parallel loops; progress of a run, its clock and its cancellation.
#include "core/parallel.h"
#include "core/run_context.h"

#include <gtest/gtest.h>

#include <new>

namespace pcl::floater {
namespace {
TEST (Parallel, TasksAndRangesCoverAllOnce)
{
  for (const int threads : {1, 2, 7})
    for (const std::size_t count : {0U, 1U, 2U, 5U, 1000U, 1023U, 1024U, 1025U, 10000U}) {
      std::vector<std::atomic<int>> runs (count);
      parallelTasks (threads, count, [&runs] (std::size_t i) { ++runs[i]; });
      parallelRanges (threads, count, [&] (std::size_t first, std::size_t last) {
        EXPECT_EQ (first % RANGE_LENGTH, 0U);
        EXPECT_EQ (last, std::min (count, first + RANGE_LENGTH));
        for (std::size_t i = first; i < last; ++i)
          runs[i] += 10;
      });
      for (const std::atomic<int>& of_one : runs)
        ASSERT_EQ (of_one, 11);
    }
}

TEST (Parallel, RethrowsWhatATaskThrows)
{
  for (const int threads : {1, 2, 5}) {
    EXPECT_THROW (parallelTasks (threads, 8, [] (std::size_t) { throw std::bad_alloc (); }),
                  std::bad_alloc);
    std::atomic<int> begun{0};
    const auto failAtOnce = [&begun] (std::size_t) {
      ++begun;
      throw std::runtime_error ("in a task");
    };
    EXPECT_THROW (parallelTasks (threads, 100000, failAtOnce), std::runtime_error);
    EXPECT_LE (begun, threads) << "no task begins after the first error";
  }
}

// Tasks that last until the run is cancelled end with it, on whatever thread they are.
TEST (RunMonitor, CancellationReachesTasksThatAreUnderWay)
{
  for (const int threads : {1, 2, 4}) {
    constexpr int LATER = 3; // when the tasks have begun
    int questions = 0;
    Callbacks callbacks;
    callbacks.cancelled = [&questions] { return ++questions == LATER; };
    Statistics statistics;
    RunMonitor monitor (callbacks, statistics);
    const RunContext run (threads, &monitor);
    std::atomic<int> begun{0};
    const auto endless = [&] (std::size_t i) {
      ++begun;
      ProgressLoop progress (run);
      while (i > 0) // task 0 ends at once: the calling thread may have to wait for the others
        progress.next ();
    };
    EXPECT_THROW (parallelTasks (run, 100, endless), Cancelled);
    EXPECT_LE (begun, threads + 1);
  }
}

// A callback slower than the time between two polls takes a tenth of the run, not all of it.
TEST (RunMonitor, SlowCallbacksAreCalledSeldom)
{
  constexpr std::chrono::milliseconds SLOW{60}, WORK{300};
  int calls = 0;
  Callbacks callbacks;
  callbacks.progress = [&] (double) {
    ++calls;
    std::this_thread::sleep_for (SLOW);
  };
  Statistics statistics;
  RunMonitor monitor (callbacks, statistics);
  const RunContext run (1, &monitor);
  run.beginStage (Stage::NEIGHBORS);
  run.beginStep (0.5);
  const auto end = std::chrono::steady_clock::now () + WORK;
  ProgressLoop progress (run, 1000);
  while (std::chrono::steady_clock::now () < end)
    progress.reach (1);
  EXPECT_EQ (calls, 1);
}

// A monitor that records its callbacks.
struct Recorder
{
  std::vector<Stage> stages;
  double done = -1.0;
  bool is_cancelled = false;
  int questions = 0;
  Statistics statistics;
  RunMonitor monitor{{[this] (Stage stage) { stages.push_back (stage); },
                      [this] (double fraction) { done = fraction; },
                      [this] {
                        ++questions;
                        return is_cancelled;
                      }},
                     statistics};

  // The fraction at this moment. After a slow callback, the next one waits.
  double now ()
  {
    for (done = -1.0; done < 0.0;)
      monitor.pollNowAndThen ();
    return done;
  }
};

TEST (RunMonitor, StepsAndLoops)
{
  const std::chrono::milliseconds usual = std::exchange (RunMonitor::between_polls, {});
  Recorder recorder;
  const RunContext run (1, &recorder.monitor);
  run.beginStage (Stage::WORKING_SET);
  EXPECT_EQ (recorder.done, 0.0);
  run.beginStage (Stage::NEIGHBORS);
  run.beginStage (Stage::NEIGHBORS); // is running already
  EXPECT_EQ (recorder.stages, (std::vector<Stage>{Stage::WORKING_SET, Stage::NEIGHBORS}));
  const double begin = recorder.done;
  EXPECT_GT (begin, 0.0);
  run.beginStep (0.5);
  {
    ProgressLoop loop (run, 10);
    loop.reach (5);
    const double half = recorder.now ();
    EXPECT_GT (half, begin);
    ProgressLoop inner (run, 10); // moves nothing
    inner.reach (10);
    const int questions = recorder.questions;
    std::thread ([&] { // neither does one of another thread, and it calls nothing back
      ProgressLoop elsewhere (run, 10);
      elsewhere.reach (10);
    })
        .join ();
    EXPECT_EQ (recorder.questions, questions);
    EXPECT_EQ (recorder.now (), half);
  }
  const double middle = recorder.now ();
  {
    ProgressLoop not_announced (run, 1);
  }
  const double later = recorder.now ();
  EXPECT_GT (later, middle);
  run.beginStage (Stage::STARS);
  const double end = recorder.done;
  EXPECT_NEAR (middle, 0.5 * (begin + end), 1e-12);
  EXPECT_NEAR (later, 0.5 * (middle + end), 1e-12);
  run.beginStage (Stage::CONSENSUS);
  EXPECT_GE (recorder.done, end);
  EXPECT_LT (recorder.done, 1.0);
  recorder.monitor.finish ();
  EXPECT_EQ (recorder.done, 1.0);
  RunMonitor::between_polls = usual;
}

} // namespace
} // namespace pcl::floater
