// SPDX-License-Identifier: GPL-3.0-or-later
// How far a run is, its clock and its cancellation.
#include "core/run_context.h"

#include <pcl/surface/floater/reconstruct.h>

#include "core/parallel.h"
#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace pcl
{
namespace floater
{
namespace
{
using samples::asInput;
using samples::discOptions;
using samples::Positions;

// As long as a monitor waits between two polls, and a little more.
constexpr std::chrono::milliseconds UNTIL_NEXT_POLL{60};

Positions
surface (SurfaceKind kind, std::size_t points)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  return generateSurface (spec);
}

// A surface and options: which stages a run goes through.
struct Way
{
  const char* name;
  SurfaceKind kind;
  Options options;
};

std::vector<Way>
allWays ()
{
  Options balls;
  balls.neighbors.kind = Neighborhood::BALL_DELAUNAY;
  Options iterative = discOptions ();
  iterative.solver.method = Solver::BICGSTAB_ILUT;
  return {{"surface", SurfaceKind::TORUS, {}},
          {"balls", SurfaceKind::TORUS, balls},
          {"disc", SurfaceKind::HEIGHT_FIELD, discOptions ()},
          {"iterative", SurfaceKind::HEIGHT_FIELD, iterative},
          {"deep disc", SurfaceKind::FINGER, discOptions ()}};
}

TEST (Progress, FractionsGrowFromZeroToOne)
{
  for (Way& way : allWays ()) {
    SCOPED_TRACE (way.name);
    std::vector<double> fractions;
    way.options.progress_callback = [&] (double fraction) { fractions.push_back (fraction); };
    const Result result = reconstruct (asInput (surface (way.kind, 4000)), way.options);
    ASSERT_EQ (result.report.status, Status::OK) << result.report.message;
    ASSERT_GE (fractions.size (), 7U); // begins of stages, and the end
    EXPECT_EQ (fractions.front (), 0.0);
    EXPECT_TRUE (std::is_sorted (fractions.begin (), fractions.end ()));
    EXPECT_LT (fractions[fractions.size () - 2], 1.0);
    EXPECT_EQ (fractions.back (), 1.0);
  }
}

TEST (Progress, CallbacksComeFromTheCallingThreadAndChangeNothing)
{
  const Positions points = surface (SurfaceKind::TORUS, 20000);
  const Result plain = reconstruct (asInput (points), {});
  for (const int threads : {1, 4}) {
    Options options;
    options.threads = threads;
    bool is_elsewhere = false;
    const std::thread::id here = std::this_thread::get_id ();
    options.progress_callback = [&] (double) {
      is_elsewhere |= std::this_thread::get_id () != here;
    };
    options.cancelled_callback = [&] {
      is_elsewhere |= std::this_thread::get_id () != here;
      return false;
    };
    const Result watched = reconstruct (asInput (points), options);
    EXPECT_EQ (watched.triangles, plain.triangles);
    EXPECT_FALSE (is_elsewhere);
  }
}

// Cancelled at the n-th question, for all n.
TEST (Cancellation, EndsTheRunWhereverItIsAskedFor)
{
  for (Way& way : allWays ())
    for (const int threads : {1, 3}) {
      SCOPED_TRACE (way.name);
      const Positions points = surface (way.kind, 500);
      way.options.threads = threads;
      int questions = 0;
      way.options.cancelled_callback = [&] { return ++questions < 0; };
      ASSERT_EQ (reconstruct (asInput (points), way.options).report.status, Status::OK);
      const int all = questions;
      EXPECT_GE (all, 7);
      for (int stop = 1; stop <= all; ++stop) {
        questions = 0;
        way.options.cancelled_callback = [&] { return ++questions == stop; };
        const Result result = reconstruct (asInput (points), way.options);
        if (questions < stop)
          continue; // the number of questions depends on time
        EXPECT_EQ (result.report.status, Status::CANCELLED);
        EXPECT_NE (result.report.message, "");
        EXPECT_TRUE (result.triangles.empty ());
        EXPECT_TRUE (result.report.loop.empty ());
        EXPECT_TRUE (result.report.parameters.empty ());
        EXPECT_EQ (questions, stop) << "asked again after the cancellation";
      }
    }
}

// Whether a run that is to be cancelled as soon as it is within a stage ends in that stage. There
// are seldom any polls in the first 50 ms after one, so the poll at the begin of the stage is made
// to last longer.
bool
isCancelledWithin (Stage stage, const Positions& points, Options options)
{
  Stage running = Stage::COUNT;
  int questions = 0; // within the stage
  options.stage_callback = [&] (Stage begun) { running = begun; };
  options.cancelled_callback = [&] {
    if (running != stage)
      return questions > 0; // too late
    if (questions++ == 0)
      std::this_thread::sleep_for (UNTIL_NEXT_POLL);
    return questions > 1;
  };
  const Result result = reconstruct (asInput (points), options);
  EXPECT_TRUE (result.report.status == Status::CANCELLED || questions < 2) << result.report.message;
  EXPECT_EQ (result.report.status == Status::CANCELLED, result.triangles.empty ());
  EXPECT_GT (questions, 0) << "the run did not come to this stage";
  return result.report.status == Status::CANCELLED && running == stage;
}

TEST (Cancellation, IsSeenWithinTheStagesOfASurface)
{
  const Positions points = surface (SurfaceKind::CUT_OUT, 5000);
  Options options;
  options.topology = Topology::SURFACE;
  options.holes.policy = HolePolicy::CLOSE_ALL;
  for (const int threads : {1, 2}) {
    options.threads = threads;
    for (const Stage stage : {Stage::WORKING_SET, Stage::NEIGHBORS, Stage::STARS, Stage::CONSENSUS,
                              Stage::HOLES, Stage::FLIPS, Stage::CHECK})
      EXPECT_TRUE (isCancelledWithin (stage, points, options)) << stageName (stage);
  }
}

TEST (Cancellation, IsSeenWithinTheStagesOfADisc)
{
  const Positions points = surface (SurfaceKind::HEIGHT_FIELD, 5000);
  Options options = discOptions ();
  options.solver.method = Solver::BICGSTAB_ILUT;
  // All but DELAUNAY, which is one call of CGAL's.
  for (const Stage stage : {Stage::WORKING_SET, Stage::NEIGHBORS, Stage::STARS, Stage::BOUNDARY,
                            Stage::WEIGHTS, Stage::SOLVE, Stage::FLIPS, Stage::CHECK})
    EXPECT_TRUE (isCancelledWithin (stage, points, options)) << stageName (stage);
}

TEST (Cancellation, IsSeenByEveryBoundaryMethod)
{
  const Positions points = surface (SurfaceKind::HEIGHT_FIELD, 5000);
  Options options = discOptions ();
  for (const BoundaryMethod method :
       {BoundaryMethod::SPANNING_TREE, BoundaryMethod::CONSENSUS, BoundaryMethod::TWO_SEGMENTS}) {
    options.boundary.method = method;
    EXPECT_TRUE (isCancelledWithin (Stage::BOUNDARY, points, options))
        << "method " << static_cast<int> (method);
  }
}

TEST (Callbacks, ExceptionsEndTheRun)
{
  Options options;
  options.cancelled_callback = [] () -> bool { throw std::runtime_error ("no answer"); };
  const Result result = reconstruct (asInput (surface (SurfaceKind::TORUS, 2000)), options);
  EXPECT_EQ (result.report.status, Status::INTERNAL_ERROR);
  EXPECT_NE (result.report.message.find ("no answer"), std::string::npos);
}

TEST (Callbacks, WhateverTheyThrowStaysInside)
{
  Options stage, progress, cancelled;
  stage.stage_callback = [] (Stage) { throw 7; };
  progress.progress_callback = [] (double fraction) {
    if (fraction > 0.3)
      throw 7;
  };
  cancelled.cancelled_callback = [] () -> bool { throw 7; };
  const Positions points = surface (SurfaceKind::TORUS, 1000);
  for (const Options& options : {stage, progress, cancelled}) {
    Result result;
    EXPECT_NO_THROW (result = reconstruct (asInput (points), options));
    EXPECT_EQ (result.report.status, Status::INTERNAL_ERROR);
    EXPECT_NE (result.report.message, "");
    EXPECT_TRUE (result.triangles.empty ());
  }
}

// A callback may run another reconstruction, with callbacks of its own: neither run sees the other.
TEST (Callbacks, MayRunAnotherReconstruction)
{
  const Positions points = surface (SurfaceKind::TORUS, 3000);
  const Positions inner_points = surface (SurfaceKind::HEIGHT_FIELD, 400);
  const Result expected = reconstruct (asInput (points), {});
  const Result inner_expected = reconstruct (asInput (inner_points), discOptions ());
  ASSERT_EQ (expected.report.status, Status::OK);
  ASSERT_EQ (inner_expected.report.status, Status::OK);
  for (const bool in_stage_callback : {true, false}) {
    std::size_t inner_runs = 0;
    const auto runAnother = [&] {
      std::vector<double> fractions;
      Options options = discOptions ();
      options.progress_callback = [&] (double fraction) { fractions.push_back (fraction); };
      const Result inner = reconstruct (asInput (inner_points), options);
      EXPECT_EQ (inner.report.status, Status::OK) << inner.report.message;
      EXPECT_EQ (inner.triangles, inner_expected.triangles);
      EXPECT_TRUE (std::is_sorted (fractions.begin (), fractions.end ()));
      EXPECT_EQ (fractions.front (), 0.0);
      EXPECT_EQ (fractions.back (), 1.0);
      ++inner_runs;
    };
    std::vector<double> fractions;
    std::vector<Stage> stages;
    Options options;
    options.stage_callback = [&] (Stage stage) {
      stages.push_back (stage);
      if (in_stage_callback)
        runAnother ();
    };
    options.progress_callback = [&] (double fraction) {
      fractions.push_back (fraction);
      if (!in_stage_callback && fractions.size () % 2 == 0)
        runAnother ();
    };
    const Result result = reconstruct (asInput (points), options);
    EXPECT_EQ (result.report.status, Status::OK) << result.report.message;
    EXPECT_EQ (result.triangles, expected.triangles);
    EXPECT_GE (inner_runs, 3U);
    EXPECT_TRUE (std::is_sorted (stages.begin (), stages.end ()));
    EXPECT_TRUE (std::is_sorted (fractions.begin (), fractions.end ()));
    EXPECT_EQ (fractions.front (), 0.0);
    EXPECT_EQ (fractions.back (), 1.0);
  }
}

// A task that lasts until the run is cancelled, on whatever thread, ends with it.
TEST (RunMonitor, CancellationReachesTasksThatAreUnderWay)
{
  for (const int threads : {1, 2, 4}) {
    const auto begin = std::chrono::steady_clock::now ();
    Callbacks callbacks;
    callbacks.cancelled = [begin] {
      return std::chrono::steady_clock::now () - begin > std::chrono::milliseconds (120);
    };
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

// A monitor that records what it tells.
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

  // The fraction at this moment.
  double now ()
  {
    std::this_thread::sleep_for (UNTIL_NEXT_POLL);
    monitor.pollNowAndThen ();
    return done;
  }
};

TEST (RunMonitor, StepsAndLoops)
{
  Recorder recorder;
  const RunContext run (1, &recorder.monitor);
  run.beginStage (Stage::WORKING_SET);
  EXPECT_EQ (recorder.done, 0.0);
  run.beginStage (Stage::NEIGHBORS);
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
  // The other method from here on: what is left is shared out anew.
  run.setMethod (Topology::DISC);
  run.beginStage (Stage::STARS);
  run.beginStage (Stage::SOLVE);
  EXPECT_GE (recorder.done, end);
  EXPECT_LT (recorder.done, 1.0);
  recorder.monitor.finish ();
  EXPECT_EQ (recorder.done, 1.0);
}

TEST (RunMonitor, BooksTimeByStage)
{
  constexpr double LEAST = 0.02;
  const auto work = [] { std::this_thread::sleep_for (std::chrono::milliseconds (20)); };
  Recorder recorder;
  const RunContext run (1, &recorder.monitor);
  work (); // before any stage
  run.beginStage (Stage::NEIGHBORS);
  work ();
  run.beginStage (Stage::NEIGHBORS); // goes on
  run.beginStage (Stage::FLIPS);
  work ();
  recorder.monitor.stopClock ();
  work (); // after all stages
  const Statistics& statistics = recorder.statistics;
  double sum = 0.0;
  for (std::size_t stage = 0; stage < statistics.seconds.size (); ++stage) {
    const bool has_run = stage == static_cast<std::size_t> (Stage::NEIGHBORS) ||
                         stage == static_cast<std::size_t> (Stage::FLIPS);
    EXPECT_EQ (statistics.seconds[stage] >= LEAST, has_run);
    EXPECT_EQ (statistics.seconds[stage] > 0.0, has_run);
    sum += statistics.seconds[stage];
  }
  EXPECT_NEAR (statistics.total_seconds, sum, 1e-9);
  EXPECT_EQ (recorder.stages, (std::vector<Stage>{Stage::NEIGHBORS, Stage::FLIPS}));
}

TEST (RunMonitor, IsWatchedIfItMayCallBackWithinAStage)
{
  Statistics statistics;
  EXPECT_FALSE (RunMonitor ({}, statistics).isWatched ());
  EXPECT_FALSE (RunMonitor ({[] (Stage) {}, {}, {}}, statistics).isWatched ());
  EXPECT_TRUE (RunMonitor ({{}, [] (double) {}, {}}, statistics).isWatched ());
  EXPECT_TRUE (RunMonitor ({{}, {}, [] { return false; }}, statistics).isWatched ());
}

TEST (RunMonitor, CallsBackOnItsOwnThreadOnly)
{
  Recorder recorder;
  const RunContext run (2, &recorder.monitor);
  run.beginStage (Stage::NEIGHBORS);
  const int questions = recorder.questions;
  const double done = recorder.done;
  const auto useElsewhere = [&] {
    ProgressLoop loop (run, 100);
    std::this_thread::sleep_for (UNTIL_NEXT_POLL);
    loop.reach (50);
    run.poll ();
  };
  std::thread (useElsewhere).join ();
  EXPECT_EQ (recorder.questions, questions);
  EXPECT_EQ (recorder.done, done);
  EXPECT_EQ (recorder.now (), done) << "moved by the other thread";
  // But a cancellation is seen there, too.
  recorder.is_cancelled = true;
  EXPECT_THROW (recorder.now (), Cancelled);
  bool is_cancelled = false;
  std::thread ([&] {
    try {
      useElsewhere ();
    }
    catch (const Cancelled&) {
      is_cancelled = true;
    }
  }).join ();
  EXPECT_TRUE (is_cancelled);
}

TEST (RunMonitor, TwoInOneThreadAreApart)
{
  Recorder outer;
  const RunContext outer_run (1, &outer.monitor);
  outer_run.beginStage (Stage::STARS);
  const double outer_done = outer.done;
  ProgressLoop outer_loop (outer_run, 2);
  {
    Recorder inner;
    const RunContext inner_run (1, &inner.monitor);
    inner_run.beginStage (Stage::WORKING_SET);
    {
      ProgressLoop inner_loop (inner_run, 2);
      inner_loop.reach (1);
      EXPECT_GT (inner.now (), 0.0) << "a loop of the other run does not count as its outer loop";
    }
    inner.is_cancelled = true;
    EXPECT_THROW (inner.now (), Cancelled);
  }
  EXPECT_EQ (outer.now (), outer_done);
  outer_loop.reach (1);
  EXPECT_GT (outer.now (), outer_done);
  EXPECT_EQ (outer.stages, (std::vector<Stage>{Stage::STARS}));
}

TEST (RunContext, WithinAStageNothingIsTold)
{
  Recorder recorder;
  const RunContext run (3, &recorder.monitor);
  run.beginStage (Stage::BOUNDARY);
  const double done = recorder.done;
  const RunContext part = run.withinStage ();
  EXPECT_EQ (part.threads (), 3);
  EXPECT_EQ (part.withThreads (2).threads (), 2);
  part.setMethod (Topology::DISC);
  part.beginStage (Stage::NEIGHBORS);
  part.withThreads (1).beginStage (Stage::CONSENSUS);
  part.beginStep (0.9);
  {
    ProgressLoop loop (part, 10);
    loop.reach (10);
    EXPECT_EQ (recorder.now (), done);
  }
  EXPECT_EQ (recorder.now (), done);
  EXPECT_EQ (recorder.stages, (std::vector<Stage>{Stage::BOUNDARY}));
  recorder.monitor.stopClock ();
  for (const Stage stage : {Stage::NEIGHBORS, Stage::CONSENSUS})
    EXPECT_EQ (recorder.statistics.seconds[static_cast<std::size_t> (stage)], 0.0);
  EXPECT_GT (recorder.statistics.seconds[static_cast<std::size_t> (Stage::BOUNDARY)], 0.0);
  // It can be cancelled, by a loop as well as at the begin of a stage.
  recorder.is_cancelled = true;
  std::this_thread::sleep_for (UNTIL_NEXT_POLL);
  ProgressLoop loop (part);
  EXPECT_THROW (loop.reach (1), Cancelled);
  EXPECT_THROW (part.beginStage (Stage::STARS), Cancelled);
}

TEST (RunContext, WithoutAMonitorIsANumberOfThreads)
{
  const RunContext run = 5;
  EXPECT_EQ (run.threads (), 5);
  EXPECT_GE (RunContext (0).threads (), 1);
  run.beginStage (Stage::SOLVE);
  run.beginStep (0.5);
  run.setMethod (Topology::DISC);
  run.poll ();
  ProgressLoop loop (run.withinStage (), 1000);
  for (int i = 0; i < 1000; ++i)
    loop.next ();
}

} // namespace
} // namespace floater
} // namespace pcl
