// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Callbacks of a whole run: its progress, its cancellation, and what else a callback may do.
#include <pcl/surface/floater/reconstruct.h>

#include "points/point_samples.h"
#include "poll_wait.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <set>
#include <thread>

namespace pcl::floater {
namespace {
using samples::asInput;
using samples::discOptions;
using samples::Positions;
using samples::surface;

// A surface and options, which decide through which stages a run goes.
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
  iterative.disc.solver.method = Solver::BICGSTAB_ILUT;
  return {{"surface", SurfaceKind::TORUS, {}},
          {"balls", SurfaceKind::TORUS, balls},
          {"disc", SurfaceKind::HEIGHT_FIELD, discOptions ()},
          {"iterative", SurfaceKind::HEIGHT_FIELD, iterative},
          {"deep disc", SurfaceKind::FINGER, discOptions ()}};
}

/// A search in the core takes the points in ranges of 1024.
TEST (Task, EachThreadTellsOfItsTasks)
{
  for (Way& way : allWays ()) {
    SCOPED_TRACE (way.name);
    constexpr std::size_t POINTS = 20'000, RANGE = 1024;
    for (const int threads : {1, 3}) {
      std::mutex mutex;
      std::size_t tasks = 0;
      std::set<std::thread::id> callers;
      way.options.threads = threads;
      way.options.task_callback = [&] {
        const std::lock_guard<std::mutex> lock (mutex);
        ++tasks;
        callers.insert (std::this_thread::get_id ());
      };
      const Result result = reconstruct (asInput (surface (way.kind, POINTS)), way.options);
      EXPECT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
      EXPECT_GT (tasks, POINTS / RANGE);
      if (threads == 1) {
        EXPECT_EQ (callers, std::set<std::thread::id>{std::this_thread::get_id ()});
      }
      else {
        EXPECT_GT (callers.size (), 1U);
      }
    }
  }
}

TEST (Progress, FractionsGrowFromZeroToOne)
{
  for (Way& way : allWays ()) {
    SCOPED_TRACE (way.name);
    std::vector<double> fractions;
    way.options.progress_callback = [&] (double fraction) { fractions.push_back (fraction); };
    const Result result = reconstruct (asInput (surface (way.kind, 4000)), way.options);
    ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
    ASSERT_GE (fractions.size (), 7U); // when stages begin, and at the end
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

// Whether a run ends in a stage if it is cancelled after the poll at the begin of that stage. A
// small cloud would be done before the next poll is due. So that first poll waits for that.
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
      samples::waitUntilAPollIsDue ();
    return questions > 1;
  };
  const Result result = reconstruct (asInput (points), options);
  EXPECT_TRUE (result.report.status == RunStatus::CANCELLED || questions < 2)
      << result.report.message;
  EXPECT_EQ (result.report.status == RunStatus::CANCELLED, result.triangles.empty ());
  EXPECT_GT (questions, 0) << "the run has not reached this stage";
  return result.report.status == RunStatus::CANCELLED && running == stage;
}

TEST (Cancellation, IsSeenWithinStages)
{
  Options options;
  options.topology = Topology::SURFACE;
  options.holes.policy = HolePolicy::CLOSE_ALL;
  for (const Stage stage : {Stage::WORKING_SET, Stage::NEIGHBORS, Stage::STARS, Stage::CONSENSUS,
                            Stage::HOLES, Stage::FLIPS, Stage::CHECK})
    EXPECT_TRUE (isCancelledWithin (stage, surface (SurfaceKind::CUT_OUT, 5000), options))
        << stageName (stage);
  Options disc = discOptions ();
  disc.disc.solver.method = Solver::BICGSTAB_ILUT;
  // All but DELAUNAY, which is a single call of CGAL.
  for (const Stage stage : {Stage::BOUNDARY, Stage::WEIGHTS, Stage::SOLVE})
    for (const BoundaryMethod method :
         {BoundaryMethod::SPANNING_TREE, BoundaryMethod::CONSENSUS, BoundaryMethod::TWO_SEGMENTS}) {
      disc.disc.boundary.method = method;
      disc.disc.boundary.cluster_tolerance = 0.2;
      EXPECT_TRUE (isCancelledWithin (stage, surface (SurfaceKind::HEIGHT_FIELD, 5000), disc))
          << stageName (stage) << ", method " << static_cast<int> (method);
    }
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
    EXPECT_EQ (result.report.status, RunStatus::INTERNAL_ERROR);
    EXPECT_NE (result.report.message, "");
    EXPECT_TRUE (result.triangles.empty ());
  }
}

// A callback may run another reconstruction with callbacks of its own. The runs do not disturb each
// other.
TEST (Callbacks, MayRunAnotherReconstruction)
{
  const Positions points = surface (SurfaceKind::TORUS, 3000);
  const Positions inner_points = surface (SurfaceKind::HEIGHT_FIELD, 400);
  const Result expected = reconstruct (asInput (points), {});
  const Result inner_expected = reconstruct (asInput (inner_points), discOptions ());
  ASSERT_EQ (expected.report.status, RunStatus::SUCCESS);
  ASSERT_EQ (inner_expected.report.status, RunStatus::SUCCESS);
  for (const bool in_stage_callback : {true, false}) {
    std::size_t inner_runs = 0;
    const auto runAnother = [&] {
      std::vector<double> fractions;
      Options options = discOptions ();
      options.progress_callback = [&] (double fraction) { fractions.push_back (fraction); };
      const Result inner = reconstruct (asInput (inner_points), options);
      EXPECT_EQ (inner.report.status, RunStatus::SUCCESS) << inner.report.message;
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
    EXPECT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
    EXPECT_EQ (result.triangles, expected.triangles);
    EXPECT_GE (inner_runs, 3U);
    EXPECT_TRUE (std::is_sorted (stages.begin (), stages.end ()));
    EXPECT_TRUE (std::is_sorted (fractions.begin (), fractions.end ()));
    EXPECT_EQ (fractions.front (), 0.0);
    EXPECT_EQ (fractions.back (), 1.0);
  }
}

} // namespace
} // namespace pcl::floater
