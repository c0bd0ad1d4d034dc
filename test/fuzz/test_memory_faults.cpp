// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of a run fails once, and once together with all later ones: the run ends with a
// status, nothing escapes, nothing leaks, and the next run is as before.
#include "failing_malloc.h"

#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace pcl::floater {
namespace {
using fuzz::MemoryFault;
using samples::Positions;

struct Way
{
  const char* name;
  Input input;
  Options options;
};

Positions
makeSurface (SurfaceKind kind, std::size_t points)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  return generateSurface (spec);
}

// A bent wall with a step in it, as a camera at the origin sees it.
Positions
makeScan (int width)
{
  Positions scan;
  for (int row = 0; row < width; ++row)
    for (int column = 0; column < width; ++column) {
      const double x = (column + 0.5) / width - 0.5, y = (row + 0.5) / width - 0.5;
      const double depth = (x > 0.2 ? 3.0 : 2.0) + 0.1 * std::sin (9.0 * y);
      scan.emplace_back (depth * x, depth * y, depth);
    }
  return scan;
}

std::vector<Way>
allWays (std::size_t points)
{
  Options disc = samples::discOptions (), iterative = disc, ordered = disc, balls, surface, view;
  iterative.disc.solver.method = Solver::BICGSTAB_ILUT;
  iterative.disc.boundary.method = BoundaryMethod::TWO_SEGMENTS;
  iterative.disc.boundary.cluster_tolerance = 0.3;
  // SuperLU itself ends the program when it finds no memory.
  ordered.disc.solver.ordering = Ordering::METIS;
  ordered.disc.boundary.method = BoundaryMethod::CONSENSUS;
  balls.neighbors.kind = Neighborhood::BALL_DELAUNAY;
  balls.trimming.minimum_component_size = 5;
  surface.holes.policy = HolePolicy::CLOSE_ALL;
  view.view.use = ViewUse::GIVEN;
  const auto make = [points] (const char* name, SurfaceKind kind, Options options) {
    options.threads = 1;
    return Way{name, samples::asInput (makeSurface (kind, points)), options};
  };
  std::vector<Way> ways{make ("disc", SurfaceKind::HEIGHT_FIELD, disc),
                        make ("hemisphere", SurfaceKind::HEMISPHERE, disc),
                        make ("iterative", SurfaceKind::HEIGHT_FIELD, iterative),
                        make ("ordered", SurfaceKind::HEIGHT_FIELD, ordered),
                        make ("surface", SurfaceKind::HEMISPHERE, surface),
                        make ("balls", SurfaceKind::TORUS, balls)};
  const auto width = static_cast<int> (std::sqrt (static_cast<double> (points)));
  view.threads = 1;
  ways.push_back ({"view", samples::asInput (makeScan (width)), view});
  return ways;
}

// Failures for each way and kind of fault, spread over all allocations; 0: at every allocation.
// PCL_FLOATER_MEMORY_FAULTS asks for another number.
std::size_t
failuresWanted ()
{
  const char* const wanted = std::getenv ("PCL_FLOATER_MEMORY_FAULTS");
  return wanted == nullptr ? 0 : std::strtoull (wanted, nullptr, 10);
}

// Points of each cloud. PCL_FLOATER_MEMORY_POINTS asks for others.
std::size_t
pointsWanted ()
{
  constexpr std::size_t FEW = 120;
  const char* const wanted = std::getenv ("PCL_FLOATER_MEMORY_POINTS");
  return wanted == nullptr ? FEW : std::strtoull (wanted, nullptr, 10);
}

class MemoryFaults : public testing::TestWithParam<std::size_t>
{
};

TEST_P (MemoryFaults, EndARunInAnOrderlyWay)
{
  const Way way = allWays (pointsWanted ())[GetParam ()];
  SCOPED_TRACE (way.name);
  const Result expected = reconstruct (way.input, way.options);
  ASSERT_EQ (expected.report.status, RunStatus::SUCCESS) << expected.report.message;
  fuzz::failAllocations (MemoryFault::NONE, 0);
  reconstruct (way.input, way.options);
  const std::size_t all = fuzz::stopFailing ();
  const std::size_t wanted = failuresWanted ();
  const std::size_t step = wanted == 0 ? 1 : std::max<std::size_t> (all / wanted, 1);
  std::size_t ended = 0, survived = 0;
  for (const MemoryFault fault : {MemoryFault::ONE, MemoryFault::ALL})
    for (std::size_t n = 0; n < all; n += step) {
      Input input = way.input; // before memory is short; reconstruct () takes it over
      const long before = fuzz::liveBlocks ();
      {
        Result result;
        bool has_thrown = false;
        fuzz::failAllocations (fault, n);
        try {
          result = reconstruct (std::move (input), way.options);
        }
        catch (...) {
          has_thrown = true;
        }
        fuzz::stopFailing ();
        EXPECT_FALSE (has_thrown) << "allocation " << n << " of " << all;
        if (result.report.status == RunStatus::SUCCESS) { // a library has done without
          ++survived;
          EXPECT_EQ (result.triangles, expected.triangles) << "allocation " << n;
        }
        else {
          ++ended;
          EXPECT_EQ (result.report.status, RunStatus::OUT_OF_MEMORY)
              << "allocation " << n << " of " << all << ": " << result.report.message;
          EXPECT_FALSE (result.report.message.empty ());
          EXPECT_TRUE (result.triangles.empty ());
        }
      }
      // The input, whose three arrays are freed, was allocated before.
      EXPECT_LE (fuzz::liveBlocks (), before) << "leak after allocation " << n << " of " << all;
    }
  EXPECT_GT (ended, survived);
  EXPECT_EQ (reconstruct (way.input, way.options).triangles, expected.triangles);
  RecordProperty ("allocations", static_cast<int> (all));
  RecordProperty ("ended", static_cast<int> (ended));
  RecordProperty ("survived", static_cast<int> (survived));
}

INSTANTIATE_TEST_SUITE_P (Ways, MemoryFaults, testing::Range<std::size_t> (0, 7));

} // namespace
} // namespace pcl::floater
