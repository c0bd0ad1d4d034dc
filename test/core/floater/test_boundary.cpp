// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/boundary.h"

#include "floater/boundary/neighbor_graph.h"
#include "floater/boundary/two_segment_loop.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using samples::makeNeighborhoods;
using samples::Neighborhoods;
using samples::Positions;
using samples::Sheet;

Boundary
find (const Neighborhoods& made, const BoundaryOptions& options)
{
  Boundary boundary = findBoundary (made.points, made.geometry, options, 1);
  checkBoundary (made.points, made.geometry.spacing, !options.loop.empty (), boundary);
  return boundary;
}

std::vector<Index>
inCloud (const Neighborhoods& made, const Boundary& boundary)
{
  std::vector<Index> loop;
  for (const Index p : boundary.loop)
    loop.push_back (made.points.cloud_index[p]);
  return loop;
}

void
expectInvalid (const Neighborhoods& made, const std::vector<Index>& loop, const std::string& why)
{
  BoundaryOptions options;
  options.loop = loop;
  const Boundary boundary = find (made, options);
  EXPECT_EQ (boundary.problem.status, RunStatus::INVALID_LOOP);
  EXPECT_NE (boundary.problem.message.find (why), std::string::npos) << boundary.problem.message;
  EXPECT_TRUE (boundary.loop.empty ());
}

TEST (Boundary, EveryMethodFindsTheBorderOfADisc)
{
  const Sheet sheet = samples::disc (0.06, 1);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  for (const BoundaryMethod method :
       {BoundaryMethod::SPANNING_TREE, BoundaryMethod::TWO_SEGMENTS}) {
    BoundaryOptions options;
    options.method = method;
    const Boundary boundary = find (made, options);
    EXPECT_FALSE (boundary.problem);
    EXPECT_EQ (samples::canonicalCycle (inCloud (made, boundary)), samples::indices (sheet.border));
    EXPECT_GE (boundary.candidates, sheet.border);
  }
}

TEST (Boundary, TheUsersLoopIsTakenAsItIs)
{
  const Sheet sheet = samples::disc (0.06, 2);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  BoundaryOptions options;
  for (Index p = 0; p < sheet.border; p += 2)
    options.loop.push_back (static_cast<Index> (sheet.border) - 1 - p);
  const Boundary boundary = find (made, options);
  EXPECT_FALSE (boundary.problem);
  EXPECT_EQ (inCloud (made, boundary), options.loop);
  EXPECT_EQ (boundary.candidates, options.loop.size ());
}

TEST (Boundary, ADuplicateInTheUsersLoopMeansThePointThatStandsForIt)
{
  Sheet sheet = samples::disc (0.1, 3);
  const auto copy = static_cast<Index> (sheet.positions.size ());
  sheet.positions.push_back (sheet.positions[7]);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  BoundaryOptions options;
  options.loop = {0, copy, 14, 21};
  EXPECT_EQ (inCloud (made, find (made, options)), (std::vector<Index>{0, 7, 14, 21}));
  expectInvalid (made, {0, 7, copy, 14}, "twice through point " + std::to_string (copy));
}

TEST (Boundary, TellsWhatIsWrongWithTheUsersLoop)
{
  Sheet sheet = samples::disc (0.1, 4);
  const auto bad = static_cast<Index> (sheet.positions.size ());
  sheet.positions.emplace_back (std::numeric_limits<double>::quiet_NaN (), 0, 0);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  expectInvalid (made, {0, 5, 10, 5}, "twice through point 5");
  expectInvalid (made, {0, 5}, "fewer than 3");
  expectInvalid (made, {0, 5, 10, bad}, "point " + std::to_string (bad));
  expectInvalid (made, {0, 5, 10, 4000000000U}, "point 4000000000");
}

TEST (Boundary, TellsWhereItsLongestStepIs)
{
  const Sheet sheet = samples::disc (0.06, 5);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  BoundaryOptions options;
  for (Index p = 0; p < sheet.border; ++p)
    if (p < 40 || p >= 60)
      options.loop.push_back (p);
  const Boundary boundary = find (made, options);
  ASSERT_LT (boundary.longest_from, made.points.cloud_index.size ());
  EXPECT_EQ (made.points.cloud_index[boundary.longest_from], 39U);
  EXPECT_GT (boundary.largest_step, 15.0);
  EXPECT_LT (boundary.largest_step, 22.0);
}

TEST (Boundary, MustNotBeShorterThanTheLimit)
{
  const Sheet sheet = samples::disc (0.06, 7);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  LoopLimits limits;
  for (const bool is_given : {false, true})
    for (const std::size_t shortest : {sheet.border, sheet.border + 1}) {
      limits.shortest_loop = shortest;
      Boundary boundary = findBoundary (made.points, made.geometry, {}, 1, limits);
      checkBoundary (made.points, made.geometry.spacing, is_given, boundary, limits);
      EXPECT_EQ (boundary.problem.status, is_given || shortest == sheet.border
                                              ? RunStatus::SUCCESS
                                              : RunStatus::NO_BOUNDARY);
    }
}

TEST (Boundary, OfAClosedSurfaceIsAProblem)
{
  Positions sphere (1500);
  for (std::size_t i = 0; i < sphere.size (); ++i) {
    const double z = 1.0 - 2.0 * (static_cast<double> (i) + 0.5) / 1500.0;
    const double angle = samples::PI * (3.0 - std::sqrt (5.0)) * static_cast<double> (i);
    sphere[i] = {std::sqrt (1.0 - z * z) * std::cos (angle),
                 std::sqrt (1.0 - z * z) * std::sin (angle), z};
  }
  const Neighborhoods made = makeNeighborhoods (sphere);
  for (const BoundaryMethod method :
       {BoundaryMethod::SPANNING_TREE, BoundaryMethod::TWO_SEGMENTS}) {
    BoundaryOptions options;
    options.method = method;
    const Boundary boundary = find (made, options);
    EXPECT_EQ (boundary.problem.status, RunStatus::NO_BOUNDARY);
    EXPECT_FALSE (boundary.problem.message.empty ());
    EXPECT_TRUE (boundary.loop.empty ());
  }
}

// Every step of every method, one by one. The monitor cancels as soon as it is asked to go on.
TEST (Boundary, CanBeCancelledInEveryStep)
{
  const Sheet sheet = samples::disc (0.01, 6);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  const Positions& positions = made.points.positions;
  std::vector<Index> loop;
  for (Index p = 0; p < made.points.size (); ++p)
    if (made.points.cloud_index[p] < sheet.border)
      loop.push_back (p);
  ASSERT_GT (loop.size (), 500U);
  const std::vector<Index> everywhere = samples::indices (positions.size ());
  const auto expectCancelled = [] (const char* step, const auto& run_step) {
    Statistics statistics;
    RunMonitor monitor ({{}, {}, [] { return true; }}, statistics);
    EXPECT_THROW (run_step (RunContext (1, &monitor)), Cancelled) << step;
  };
  expectCancelled ("gaps", [&] (const RunContext& run) {
    findGaps (made.geometry.stars, made.geometry.spacing, 1.5, run);
  });
  expectCancelled ("refinement", [&] (const RunContext& run) {
    refineLoop (positions, made.geometry.stars, made.geometry.spacing, everywhere, loop, run);
  });
  expectCancelled ("clusters", [&] (const RunContext& run) {
    clusterBoundaryPoints (positions, loop, 0.1, 10, run);
  });
  expectCancelled ("graph", [&] (const RunContext& run) { neighborGraph (positions, 3, run); });
  expectCancelled ("segments",
                   [&] (const RunContext& run) { twoSegmentLoop (positions, loop, run); });
  for (const BoundaryMethod method :
       {BoundaryMethod::SPANNING_TREE, BoundaryMethod::TWO_SEGMENTS}) {
    BoundaryOptions options;
    options.method = method;
    expectCancelled ("all", [&] (const RunContext& run) {
      findBoundary (made.points, made.geometry, options, run);
    });
  }
}

} // namespace
} // namespace pcl::floater
