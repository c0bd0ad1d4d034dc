// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Status and message of runs that fail, and the stages of a run.
#include <pcl/surface/floater/reconstruct.h>

#include "core/index_limit.h"
#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace pcl::floater {
namespace {
using samples::asInput;
using samples::discOptions;
using samples::Positions;

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN ();

void
expectFailure (const Result& result, RunStatus status, const std::string& why)
{
  EXPECT_EQ (result.report.status, status) << result.report.message;
  EXPECT_NE (result.report.message.find (why), std::string::npos) << result.report.message;
  EXPECT_TRUE (result.triangles.empty ());
}

Positions
discAt (const Eigen::Vector3d& place, double radius, std::uint64_t seed)
{
  Positions points = samples::disc (0.1, seed).positions;
  for (Eigen::Vector3d& p : points)
    p = place + radius * p;
  return points;
}

TEST (RunStatus, TooFewPoints)
{
  expectFailure (reconstruct (Input (), {}), RunStatus::TOO_FEW_POINTS, "0 distinct finite points");
  const Positions three = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  expectFailure (reconstruct (asInput (three), {}), RunStatus::TOO_FEW_POINTS, "3 distinct");
  Positions equal (50, Eigen::Vector3d (1, 2, 3));
  const Result one = reconstruct (asInput (equal), {});
  expectFailure (one, RunStatus::TOO_FEW_POINTS, "1 distinct");
  EXPECT_EQ (one.report.duplicates.size (), 49U);
  const Positions nowhere (20, Eigen::Vector3d::Constant (NOT_A_NUMBER));
  const Result none = reconstruct (asInput (nowhere), {});
  expectFailure (none, RunStatus::TOO_FEW_POINTS, "0 distinct");
  EXPECT_EQ (none.report.non_finite.size (), 20U);
}

TEST (RunStatus, NoInput)
{
  expectFailure (reconstruct (Positions ()), RunStatus::NO_INPUT, "empty");
}

TEST (RunStatus, Degenerate)
{
  Positions line;
  for (int i = 0; i < 100; ++i)
    line.emplace_back (0.1F * static_cast<float> (i), 0.7F * static_cast<float> (i), 3.0);
  expectFailure (reconstruct (asInput (line), {}), RunStatus::DEGENERATE, "one line");
}

TEST (RunStatus, NoBoundary)
{
  for (const SurfaceKind kind : {SurfaceKind::SPHERE, SurfaceKind::TORUS}) {
    SurfaceSpec spec;
    spec.kind = kind;
    spec.points = 3000;
    const Result result = reconstruct (asInput (generateSurface (spec)), discOptions ());
    expectFailure (result, RunStatus::NO_BOUNDARY, "closed");
    EXPECT_TRUE (result.report.loop.empty ());
  }
}

TEST (RunStatus, Unreachable)
{
  Positions three;
  for (std::uint64_t i = 0; i < 3; ++i)
    for (const Eigen::Vector3d& p : discAt ({10.0 * static_cast<double> (i), 0, 0}, 1.0, i + 1))
      three.push_back (p);
  expectFailure (reconstruct (asInput (three), discOptions ()), RunStatus::UNREACHABLE,
                 "do not connect");
}

TEST (RunStatus, ASmallSecondComponentIsLeftOutAndNamed)
{
  Positions cloud = samples::disc (0.05, 1).positions;
  const std::size_t large = cloud.size ();
  for (const Eigen::Vector3d& p : discAt ({10, 0, 0}, 0.5, 2))
    cloud.push_back (p);
  const Result result = reconstruct (asInput (cloud), discOptions ());
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  EXPECT_EQ (result.report.unused.size (), cloud.size () - large);
  EXPECT_EQ (result.report.unused.front (), large);
  EXPECT_EQ (result.report.statistics.used_points, large);
  ASSERT_FALSE (result.report.warnings.empty ());
  EXPECT_NE (result.report.warnings.back ().find (std::to_string (cloud.size () - large)),
             std::string::npos);
  EXPECT_TRUE (result.report.parameters.back ().hasNaN ());
  const samples::Topology topology = samples::topologyOf (result.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.vertices, large);
  EXPECT_EQ (topology.euler, 1);
}

TEST (RunStatus, InvalidLoop)
{
  const Positions cloud = samples::disc (0.1, 3).positions;
  Options options = discOptions ();
  options.disc.boundary.loop = {0, 10};
  expectFailure (reconstruct (asInput (cloud), options), RunStatus::INVALID_LOOP, "fewer than 3");
  options.disc.boundary.loop = {0, 10, 20, 10};
  expectFailure (reconstruct (asInput (cloud), options), RunStatus::INVALID_LOOP, "point 10");
  options.disc.boundary.loop = {0, 10, 20, static_cast<Index> (cloud.size ())};
  expectFailure (reconstruct (asInput (cloud), options), RunStatus::INVALID_LOOP,
                 std::to_string (cloud.size ()));
}

TEST (RunStatus, InvalidOption)
{
  const Positions cloud = samples::disc (0.1, 4).positions;
  Options options = discOptions ();
  options.neighbors.k = 5;
  const Result result = reconstruct (asInput (cloud), options);
  expectFailure (result, RunStatus::INVALID_OPTION, "neighbors must be from 6 to 200");
  EXPECT_EQ (options.neighbors.k, 5);
}

// Throws what it was made with.
template <typename Exception>
class BrokenSearch : public NeighborSearch
{
public:
  explicit BrokenSearch (Exception exception) : exception_ (std::move (exception)) {}
  void build (const std::vector<std::uint32_t>&) override {}
  void nearest (std::uint32_t, int, std::vector<std::uint32_t>&) override { throw exception_; }

private:
  Exception exception_;
};

// Points along a curve are in no triangle: an empty mesh is no success.
TEST (RunStatus, PointsAlongACurveAreDegenerate)
{
  Positions curve;
  for (int i = 0; i < 60; ++i)
    curve.emplace_back (i, 1e-3 * std::sin (7.0 * i), 1e-3 * std::cos (5.0 * i));
  for (const Topology topology : {Topology::AUTO, Topology::SURFACE}) {
    Options options;
    options.topology = topology;
    expectFailure (reconstruct (asInput (curve), options), RunStatus::DEGENERATE,
                   "no three points");
  }
}

TEST (RunStatus, ExceptionsBecomeStatuses)
{
  const Positions cloud = samples::disc (0.1, 5).positions;
  BrokenSearch<std::bad_alloc> no_memory{std::bad_alloc ()};
  expectFailure (reconstruct (asInput (cloud, &no_memory), {}), RunStatus::OUT_OF_MEMORY, "memory");
  BrokenSearch<std::runtime_error> broken{std::runtime_error ("the tree fell over")};
  expectFailure (reconstruct (asInput (cloud, &broken), {}), RunStatus::INTERNAL_ERROR,
                 "the tree fell over");
}

// Arrays that would make the run write outside of its own.
TEST (RunStatus, InvalidInput)
{
  const Input good = asInput (samples::disc (0.1, 7).positions);
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
  expectRefusal ([&] (Input& input) { input.lattice_width = input.cloud_size - 1; },
                 "rows of the organized cloud");
  expectRefusal ([] (Input& input) { input.cloud_index[3] = 4'000'000'000; }, "4000000000");
  expectRefusal ([] (Input& input) { input.cloud_index[20] = 5; }, "5 is given twice");
  Input turned = good; // indices may come in any order
  std::reverse (turned.cloud_index.begin (), turned.cloud_index.end ());
  EXPECT_EQ (reconstruct (turned, {}).report.status, RunStatus::SUCCESS);
}

// A run that outgrows 32 bits tells what to do; it is no error of the library.
TEST (RunStatus, TablesThatAreTooLarge)
{
  const Positions cloud = samples::disc (0.1, 5).positions;
  BrokenSearch<IndexLimitReached> limit{IndexLimitReached ("the table of neighbours is full")};
  expectFailure (reconstruct (asInput (cloud, &limit), {}), RunStatus::OUT_OF_MEMORY, "is full");
  BrokenSearch<std::length_error> length{std::length_error ("vector::_M_default_append")};
  expectFailure (reconstruct (asInput (cloud, &length), {}), RunStatus::OUT_OF_MEMORY,
                 "use fewer points");
}

TEST (Stages, ComeInOrder)
{
  const Positions cloud = samples::disc (0.1, 6).positions;
  Options options = discOptions ();
  std::vector<Stage> stages;
  options.stage_callback = [&stages] (Stage stage) { stages.push_back (stage); };
  const Result result = reconstruct (asInput (cloud), options);
  EXPECT_EQ (stages, (std::vector<Stage>{Stage::WORKING_SET, Stage::NEIGHBORS, Stage::STARS,
                                         Stage::BOUNDARY, Stage::WEIGHTS, Stage::SOLVE,
                                         Stage::DELAUNAY, Stage::FLIPS, Stage::CHECK}));
  const Statistics& statistics = result.report.statistics;
  double sum = 0.0;
  for (std::size_t stage = 0; stage < statistics.seconds.size (); ++stage) {
    const double seconds = statistics.seconds[stage];
    const bool has_run =
        std::find (stages.begin (), stages.end (), static_cast<Stage> (stage)) != stages.end ();
    EXPECT_EQ (seconds > 0.0, has_run) << stageName (static_cast<Stage> (stage));
    sum += seconds;
  }
  EXPECT_NEAR (statistics.total_seconds, sum, 1e-9);
}

TEST (Stages, EndWithTheOneThatFails)
{
  Options options = discOptions ();
  std::vector<Stage> stages;
  options.stage_callback = [&stages] (Stage stage) { stages.push_back (stage); };
  reconstruct (asInput ({{0, 0, 0}, {1, 0, 0}}), options);
  EXPECT_EQ (stages, (std::vector<Stage>{Stage::WORKING_SET}));
  stages.clear ();
  options.neighbors.k = 0;
  const Result result = reconstruct (asInput ({{0, 0, 0}, {1, 0, 0}}), options);
  EXPECT_TRUE (stages.empty ());
  EXPECT_EQ (result.report.statistics.total_seconds, 0.0);
}

} // namespace
} // namespace pcl::floater
