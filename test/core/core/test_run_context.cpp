// SPDX-License-Identifier: GPL-3.0-or-later
// How far a run is, and its stop.
#include "core/run_context.h"

#include <pcl/surface/floater/reconstruct.h>

#include "core/parallel.h"
#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

#include <chrono>
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

Positions
makePoints (SurfaceKind kind, std::size_t points)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  return generateSurface (spec);
}

// Surfaces and options of all ways that a run may take.
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
  balls.neighborhood = Neighborhood::BALL_DELAUNAY;
  Options iterative = discOptions ();
  iterative.solver = Solver::BICGSTAB_ILUT;
  return {{"surface", SurfaceKind::TORUS, {}},
          {"balls", SurfaceKind::TORUS, balls},
          {"disc", SurfaceKind::HEIGHT_FIELD, discOptions ()},
          {"iterative", SurfaceKind::HEIGHT_FIELD, iterative},
          {"deep disc", SurfaceKind::FINGER, discOptions ()}};
}

TEST (Monitor, FractionsGrowFromZeroToOne)
{
  for (Way& way : allWays ()) {
    SCOPED_TRACE (way.name);
    std::vector<double> fractions;
    way.options.progress_callback = [&] (double fraction) { fractions.push_back (fraction); };
    const Result result = reconstruct (asInput (makePoints (way.kind, 4000)), way.options);
    ASSERT_EQ (result.report.status, Status::OK) << result.report.message;
    ASSERT_GE (fractions.size (), 7U); // begins of stages, and the end
    EXPECT_EQ (fractions.front (), 0.0);
    EXPECT_TRUE (std::is_sorted (fractions.begin (), fractions.end ()));
    EXPECT_LT (fractions[fractions.size () - 2], 1.0);
    EXPECT_EQ (fractions.back (), 1.0);
  }
}

TEST (Monitor, CallbacksComeFromTheCallingThreadAndChangeNothing)
{
  const Positions points = makePoints (SurfaceKind::TORUS, 20000);
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

// Stopped at the n-th question, for all n: there is an answer wherever it is asked.
TEST (Monitor, StopsWhereverItIsAsked)
{
  for (Way& way : allWays ())
    for (const int threads : {1, 3}) {
      SCOPED_TRACE (way.name);
      const Positions points = makePoints (way.kind, 500);
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
          continue; // how often it is asked depends on time
        EXPECT_EQ (result.report.status, Status::CANCELLED);
        EXPECT_NE (result.report.message, "");
        EXPECT_TRUE (result.triangles.empty ());
        EXPECT_TRUE (result.report.loop.empty ());
        EXPECT_TRUE (result.report.parameters.empty ());
        EXPECT_EQ (questions, stop) << "asked again after the stop";
      }
    }
}

TEST (Monitor, ExceptionsOfCallbacksEndTheRun)
{
  Options options;
  options.cancelled_callback = [] () -> bool { throw std::runtime_error ("no answer"); };
  const Result result = reconstruct (asInput (makePoints (SurfaceKind::TORUS, 2000)), options);
  EXPECT_EQ (result.report.status, Status::INTERNAL_ERROR);
  EXPECT_NE (result.report.message.find ("no answer"), std::string::npos);
}

// A task that waits for the end of the run, on whatever thread, is stopped within it.
TEST (Monitor, StopReachesTasksThatAreUnderWay)
{
  Options options;
  auto begin = std::chrono::steady_clock::now ();
  options.cancelled_callback = [&] {
    return std::chrono::steady_clock::now () - begin > std::chrono::milliseconds (120);
  };
  for (const int threads : {1, 2, 4}) {
    begin = std::chrono::steady_clock::now ();
    Monitor monitor (options);
    std::atomic<int> begun{0};
    const auto endless = [&] (std::size_t i) {
      ++begun;
      MonitoredLoop progress;
      while (i > 0) // task 0 ends at once: the calling thread may have to wait for the others
        progress.next ();
    };
    EXPECT_THROW (parallelTasks (100, threads, endless), Cancelled);
    EXPECT_LE (begun, threads + 1);
  }
}

TEST (Monitor, StepsAndLoops)
{
  Options options;
  double done = -1.0;
  options.progress_callback = [&] (double fraction) { done = fraction; };
  Monitor monitor (options);
  const auto now = [&] {
    monitor.poll ();
    return done;
  };
  monitor.enterStage (Stage::WORKING_SET);
  EXPECT_EQ (now (), 0.0);
  monitor.enterStage (Stage::NEIGHBORS);
  const double begin = now ();
  EXPECT_GT (begin, 0.0);
  monitor.enterStep (0.5);
  {
    MonitoredLoop loop (10);
    loop.reach (5);
    const double half = now ();
    EXPECT_GT (half, begin);
    MonitoredLoop inner (10); // moves nothing
    inner.reach (10);
    EXPECT_EQ (now (), half);
  }
  const double middle = now ();
  {
    MonitoredLoop not_announced (1);
  }
  const double later = now ();
  EXPECT_GT (later, middle);
  monitor.enterStage (Stage::STARS);
  const double end = now ();
  EXPECT_NEAR (middle, 0.5 * (begin + end), 1e-12);
  EXPECT_NEAR (later, 0.5 * (middle + end), 1e-12);
  // The other method, in the middle of the way: what is left is shared out anew.
  monitor.setMethod (Topology::DISC);
  monitor.enterStage (Stage::STARS);
  monitor.enterStage (Stage::SOLVE);
  EXPECT_GE (now (), end);
  EXPECT_LT (now (), 1.0);
  monitor.finish ();
  EXPECT_EQ (done, 1.0);
}

TEST (Monitor, BelongsToItsThreadAndScope)
{
  EXPECT_EQ (Monitor::current (), nullptr);
  Options options;
  {
    const Monitor without_callbacks (options);
    EXPECT_EQ (Monitor::current (), nullptr);
  }
  options.cancelled_callback = [] { return false; };
  const Monitor outer (options);
  {
    const Monitor inner (options);
    EXPECT_EQ (Monitor::current (), &inner);
    Monitor* elsewhere = &const_cast<Monitor&> (inner);
    std::thread ([&] { elsewhere = Monitor::current (); }).join ();
    EXPECT_EQ (elsewhere, nullptr);
  }
  EXPECT_EQ (Monitor::current (), &outer);
}

} // namespace
} // namespace floater
} // namespace pcl
