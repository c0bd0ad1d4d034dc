// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Status and message of runs that fail, the stages of a run, and its callbacks.
#include <pcl/surface/floater/reconstruct.h>

#include "core/csr_lists.h"
#include "core/geometry.h"
#include "core/run_context.h"
#include "mesh/known_meshes.h"
#include "options/option_rows.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <new>

namespace pcl::floater {
namespace {
using namespace samples;

void
expectFailure (const Result& result, RunStatus status, const std::string& why)
{
  EXPECT_EQ (result.report.status, status) << result.report.message;
  EXPECT_NE (result.report.message.find (why), std::string::npos) << result.report.message;
  EXPECT_TRUE (result.triangles.empty ());
  EXPECT_TRUE (result.report.loop.empty () || status != RunStatus::NO_BOUNDARY);
}

TEST (RunStatus, OfRunsThatFail)
{
  Positions line, curve, three_discs;
  for (int i = 0; i < 100; ++i)
    line.emplace_back (0.1F * static_cast<float> (i), 0.7F * static_cast<float> (i), 3.0);
  for (int i = 0; i < 120; ++i)
    curve.emplace_back (i, 1e-3 * std::sin (7.0 * i), 1e-3 * std::cos (5.0 * i));
  for (std::uint64_t i = 0; i < 3; ++i)
    three_discs = joined (three_discs, placed (samples::disc (0.1, i + 1).positions,
                                               {10.0 * static_cast<double> (i), 0, 0}));
  const Positions disc = samples::disc (0.1, 3).positions;
  const auto size = static_cast<Index> (disc.size ());
  Positions apart = curve; // three curves, too far apart for a scan
  for (const double y : {300.0, 600.0})
    apart = joined (apart, placed (curve, {0.0, y, 0.0}));
  Positions on_ray{{0.0, 1e-3, 5.0}}; // but for this one
  for (int i = 1; i < 10; ++i)
    on_ray.emplace_back (0.0, 0.0, i);
  constexpr Index AROUND = 60;
  const Positions torus = samples::torus (AROUND, 12).positions;
  const Options around_cells =
      discOptions ({0, 1, 2, AROUND + 2, 2 * AROUND + 2, 2 * AROUND + 1, 2 * AROUND, AROUND});
  Options made_surface, no_view, few_neighbors = discOptions (), few_iterations = discOptions (),
                                 view, short_edges, many_points, normals, all_points;
  made_surface.topology = Topology::SURFACE;
  no_view.view.use = ViewUse::NEVER;
  few_neighbors.neighbors.k = 5;
  few_iterations.disc.solver.method = Solver::BICGSTAB_ILUT;
  few_iterations.disc.solver.max_iterations = 2;
  view.view.use = ViewUse::GIVEN; // from the origin
  short_edges.trimming.maximum_edge_length = 1e-3;
  many_points.trimming.minimum_component_size = 1 << 20;
  normals.facing = Facing::NORMALS;
  all_points.remove_outliers = false;
  const struct
  {
    RunStatus status;
    std::string why;
    Positions points;
    Options options;
  } failures[] = {
      {RunStatus::TOO_FEW_POINTS, "0 distinct finite points", {}, {}},
      {RunStatus::TOO_FEW_POINTS, "3 distinct", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}},
      {RunStatus::TOO_FEW_POINTS, "1 distinct", Positions (50, {1, 2, 3}), {}},
      {RunStatus::TOO_FEW_POINTS, "0 distinct", Positions (20, {0, 0, std::nan ("")}), {}},
      {RunStatus::DEGENERATE, "one line", line, {}},
      // Points along a curve are in no triangle: an empty mesh is no success.
      {RunStatus::DEGENERATE, "along curves", curve, {}},
      {RunStatus::DEGENERATE, "along curves", curve, made_surface},
      {RunStatus::DEGENERATE, "profiles", curve, no_view},
      {RunStatus::DEGENERATE, " times as far apart", apart, no_view},
      {RunStatus::NO_BOUNDARY, "closed", surface (SurfaceKind::SPHERE, 3000), discOptions ()},
      {RunStatus::NO_BOUNDARY, "closed", surface (SurfaceKind::TORUS, 3000), discOptions ()},
      {RunStatus::UNREACHABLE, "do not connect", three_discs, discOptions ()},
      {RunStatus::INVALID_LOOP, "fewer than 3", disc, discOptions ({0, 10})},
      {RunStatus::INVALID_LOOP, "point 10", disc, discOptions ({0, 10, 20, 10})},
      {RunStatus::INVALID_LOOP, std::to_string (size), disc, discOptions ({0, 10, 20, size})},
      {RunStatus::INVALID_OPTION, "neighbors must be from 6 to 200", disc, few_neighbors},
      {RunStatus::NOT_CONVERGED, "BiCGSTAB", disc, few_iterations},
      {RunStatus::NOT_A_DISC, "folded", torus, around_cells},
      {RunStatus::DEGENERATE, "the cloud is no surface: 4000 points", randomPoints (4000, 1), {}},
      {RunStatus::DEGENERATE, "point 720", joined (torus, {{3.4e38, 0, 0}}), all_points},
      {RunStatus::DEGENERATE,
       "double precision",
       joined (torus, placed (disc, {0, 0, 0}, 1e30)),
       {}},
      {RunStatus::DEGENERATE,
       "all that there were, were cut off as asked for (edges longer than 0.001 units of the "
       "cloud)",
       disc, short_edges},
      {RunStatus::DEGENERATE, "as asked for (components of fewer than 1048576 points)", disc,
       many_points},
      {RunStatus::INVALID_OPTION, "viewpoint", on_ray, view},
      {RunStatus::INVALID_OPTION, "have no normals", disc, normals}};
  for (const auto& failure : failures)
    expectFailure (reconstruct (asInput (failure.points), failure.options), failure.status,
                   failure.why);
  expectFailure (reconstruct (Positions ()), RunStatus::NO_INPUT, "empty");

  const Report report = reconstruct (asInput (disc), few_iterations).report;
  EXPECT_EQ (report.statistics.iterations_u, 2U);
  EXPECT_EQ (report.statistics.iterations_v, 2U);
  EXPECT_GT (report.statistics.relative_residual, few_iterations.disc.solver.tolerance);
}

// Three turns, `steps` times as far apart as their points, whose noise has `noise` steps.
Positions
turns (double steps, double noise)
{
  constexpr int POINTS = 300;
  constexpr double STEP = 2.0 * PI / POINTS;
  RandomStream random (7);
  Positions points;
  for (int i = 0; i < 3 * POINTS; ++i) {
    const double angle = STEP * i,
                 radius = 1.0 + 0.2 * std::sin (3.0 * angle) + noise * STEP * random.normal ();
    points.push_back (polar (radius, angle, steps * STEP * (i / POINTS)));
  }
  return points;
}

// Noise hides the lines of a sensor that turns and moves on: the rays from its axis tell them.
TEST (RunStatus, TurnsTooFarApartAreNoSurface)
{
  for (const double noise : {0.0, 1.0, 4.0})
    expectFailure (reconstruct (asInput (turns (40.0, noise)), {}), RunStatus::DEGENERATE,
                   "along curves");
  for (const double noise : {0.0, 1.0})
    meshOf (turns (5.0, noise));
  // The rays to points of a spiral, which fill a plate, have steps of two or three sizes.
  Positions plates;
  for (int i = 0; i < 3 * 300; ++i)
    plates.push_back (polar (std::sqrt (i % 300 + 0.5), 2.399963 * i, 40.0 * (i / 300)));
  meshOf (plates);
}

// Throws.
struct BrokenSearch : NeighborSearch
{
  explicit BrokenSearch (void (*broken) ()) : fault (broken) {}
  void build (const std::vector<std::uint32_t>&) override {}
  void nearest (std::uint32_t, int, std::vector<std::uint32_t>&) override { fault (); }
  void (*fault) ();
};

// A run that outgrows 32 bits tells what to do; it is no error of the library.
TEST (RunStatus, ExceptionsBecomeStatuses)
{
  const struct
  {
    RunStatus status;
    const char* why;
    void (*fault) ();
  } faults[] = {
      {RunStatus::OUT_OF_MEMORY, "memory", [] { throw std::bad_alloc (); }},
      {RunStatus::OUT_OF_MEMORY, "is full", [] { throw IndexLimitReached ("the table is full"); }},
      {RunStatus::OUT_OF_MEMORY, "use fewer points", [] { throw std::length_error ("vector"); }},
      {RunStatus::INTERNAL_ERROR, "fell over", [] { throw std::runtime_error ("it fell over"); }}};
  const Positions cloud = disc (0.1, 5).positions;
  for (const auto& [status, why, fault] : faults) {
    BrokenSearch search (fault);
    expectFailure (reconstruct (asInput (cloud, &search), {}), status, why);
  }
}

// Arrays that would make the run write outside of its own.
TEST (RunStatus, InvalidInput)
{
  const Input good = asInput (disc (0.1, 7).positions);
  const auto expectRefusal = [&good] (const auto& change, const std::string& why) {
    Input wrong = good;
    change (wrong);
    for (const Options& options : {Options (), discOptions ()})
      expectFailure (reconstruct (wrong, options), RunStatus::INVALID_INDICES, why);
  };
  const std::string size = std::to_string (good.positions.size ());
  expectRefusal ([] (Input& input) { input.cloud_index.pop_back (); }, size + " positions");
  expectRefusal ([] (Input& input) { input.cloud_index.push_back (0); }, size + " positions");
  expectRefusal ([] (Input& input) { input.cloud_index.clear (); }, "0 cloud indices");
  expectRefusal ([] (Input& input) { input.cloud_size = 10; }, "outside the cloud of size 10");
  expectRefusal ([] (Input& input) { input.cloud_index[3] = 4'000'000'000; }, "4000000000");
  expectRefusal ([] (Input& input) { input.cloud_index[20] = 5; }, "5 is given twice");
  expectRefusal ([] (Input& input) { input.normals.resize (input.cloud_size - 1); }, "normals");
  expectRefusal ([] (Input& input) { input.facing_normals.resize (input.cloud_size - 1); },
                 "normals");
  Input turned = good; // indices may come in any order
  std::reverse (turned.cloud_index.begin (), turned.cloud_index.end ());
  EXPECT_EQ (reconstruct (turned, {}).report.status, RunStatus::SUCCESS);
}

TEST (Stages, ComeInOrderAndEndWithTheOneThatFails)
{
  Options options = discOptions ();
  options.disc.boundary.method = BoundaryMethod::CONSENSUS; // whose own stages are none of the run
  std::vector<Stage> stages;
  options.stage_callback = [&stages] (Stage stage) { stages.push_back (stage); };
  const Report report = reconstruct (asInput (disc (0.1, 6).positions), options).report;
  EXPECT_EQ (stages, (std::vector<Stage>{Stage::WORKING_SET, Stage::NEIGHBORS, Stage::STARS,
                                         Stage::BOUNDARY, Stage::WEIGHTS, Stage::SOLVE,
                                         Stage::DELAUNAY, Stage::FLIPS, Stage::CHECK}));
  for (const Stage stage : stages)
    EXPECT_GT (report.statistics.seconds[static_cast<std::size_t> (stage)], 0.0);

  stages.clear ();
  reconstruct (asInput ({{0, 0, 0}, {1, 0, 0}}), options);
  EXPECT_EQ (stages, (std::vector<Stage>{Stage::WORKING_SET}));
  stages.clear ();
  options.neighbors.k = 0;
  const Result refused = reconstruct (asInput ({{0, 0, 0}, {1, 0, 0}}), options);
  EXPECT_TRUE (stages.empty ());
  EXPECT_EQ (refused.report.statistics.total_seconds, 0.0);
}

// Progress and cancellation are asked of the calling thread, whatever the number of threads.
TEST (Callbacks, ComeFromTheirThreadsAndChangeNothing)
{
  Options iterative = discOptions ();
  iterative.disc.solver.method = Solver::BICGSTAB_ILUT;
  const std::thread::id here = std::this_thread::get_id ();
  for (auto& [kind, options] :
       std::vector<std::pair<SurfaceKind, Options>>{{SurfaceKind::TORUS, {}},
                                                    {SurfaceKind::HEIGHT_FIELD, iterative},
                                                    {SurfaceKind::FINGER, discOptions ()}}) {
    constexpr std::size_t POINTS = 20'000;
    const Positions points = surface (kind, POINTS);
    const Result plain = reconstruct (asInput (points), options);
    for (const int threads : {1, 3}) {
      SCOPED_TRACE (std::to_string (static_cast<int> (kind)) + ", " + std::to_string (threads));
      std::set<std::thread::id> of_calls;
      std::vector<double> fractions;
      Options watched = options;
      watched.threads = threads;
      watched.progress_callback = [&] (double fraction) {
        fractions.push_back (fraction);
        of_calls.insert (std::this_thread::get_id ());
      };
      watched.cancelled_callback = [&] {
        of_calls.insert (std::this_thread::get_id ());
        return false;
      };
      const Result result = meshOf (points, watched);
      EXPECT_EQ (result.triangles, plain.triangles);
      EXPECT_EQ (of_calls, std::set<std::thread::id>{here});
      ASSERT_GE (fractions.size (), 7U); // when stages begin, and at the end
      EXPECT_EQ (fractions.front (), 0.0);
      EXPECT_TRUE (std::is_sorted (fractions.begin (), fractions.end ()));
      EXPECT_LT (fractions[fractions.size () - 2], 1.0);
      EXPECT_EQ (fractions.back (), 1.0);
    }
  }
}

// Expects that it is asked within these stages, and not only at their begins, whether to go on. That a run then ends
// is tested for each method (test_invariants.cpp). A small cloud would be done before the next poll is due: so every
// poll is. After a slow callback, the next poll waits. On a busy machine any callback may seem slow, so that one miss
// proves nothing.
void
expectQuestionsWithin (std::set<Stage> stages, const Positions& points, Options options)
{
  std::map<Stage, int> questions;
  Stage running = Stage::COUNT;
  options.stage_callback = [&] (Stage begun) { running = begun; };
  options.cancelled_callback = [&] { return ++questions[running] < 0; };
  const std::chrono::milliseconds usual = std::exchange (RunMonitor::between_polls, {});
  for (int tries = 0; tries < 5 && !stages.empty (); ++tries) {
    questions.clear ();
    meshOf (points, options);
    for (const auto& [stage, count] : questions)
      if (count > 1)
        stages.erase (stage);
  }
  RunMonitor::between_polls = usual;
  EXPECT_TRUE (stages.empty ()) << stageName (*stages.begin ());
}

TEST (Cancellation, IsAskedForWithinStages)
{
  Options options, disc = discOptions ();
  options.holes.policy = HolePolicy::CLOSE_ALL;
  expectQuestionsWithin ({Stage::WORKING_SET, Stage::NEIGHBORS, Stage::STARS, Stage::CONSENSUS,
                          Stage::HOLES, Stage::FLIPS, Stage::CHECK},
                         surface (SurfaceKind::CUT_OUT, 5000), options);
  disc.disc.solver.method = Solver::BICGSTAB_ILUT;
  disc.disc.boundary.cluster_tolerance = 0.2;
  for (const auto& [name, method] : BOUNDARY_CHOICES) {
    SCOPED_TRACE (name);
    disc.disc.boundary.method = method;
    // All but DELAUNAY, which is a single call of CGAL.
    expectQuestionsWithin ({Stage::BOUNDARY, Stage::WEIGHTS, Stage::SOLVE},
                           surface (SurfaceKind::HEIGHT_FIELD, 5000), disc);
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
    expectFailure (result, RunStatus::INTERNAL_ERROR, "");
    EXPECT_NE (result.report.message, "");
  }
}

} // namespace
} // namespace pcl::floater
