// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_options.h"

#include "core/types.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
constexpr double NO_NUMBER = std::numeric_limits<double>::quiet_NaN ();
constexpr double INF = std::numeric_limits<double>::infinity ();

// Checks which values of an option in a group are in range.
template <typename Group, typename Value>
void
expectRange (Group Options::*group, Value Group::*option, std::initializer_list<Value> good,
             std::initializer_list<Value> bad)
{
  Options options;
  for (const Value value : good) {
    options.*group.*option = value;
    EXPECT_FALSE (checkOptions (options)) << value;
  }
  for (const Value value : bad) {
    options.*group.*option = value;
    const Problem problem = checkOptions (options);
    EXPECT_EQ (problem.status, RunStatus::INVALID_OPTION) << value;
    EXPECT_FALSE (problem.message.empty ());
  }
}

// The same for a group of what only a disc takes.
template <typename Group, typename Value>
void
expectDiscRange (Group DiscOptions::*group, Value Group::*option, std::initializer_list<Value> good,
                 std::initializer_list<Value> bad)
{
  Options options;
  for (const Value value : good) {
    options.disc.*group.*option = value;
    EXPECT_FALSE (checkOptions (options)) << value;
  }
  for (const Value value : bad) {
    options.disc.*group.*option = value;
    EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_OPTION) << value;
  }
}

// The same for an option without a group.
void
expectRange (int Options::*option, std::initializer_list<int> good, std::initializer_list<int> bad)
{
  Options options;
  for (const int value : good) {
    options.*option = value;
    EXPECT_FALSE (checkOptions (options)) << value;
  }
  for (const int value : bad) {
    options.*option = value;
    EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_OPTION) << value;
  }
}

TEST (CheckOptions, NumbersHaveRanges)
{
  EXPECT_FALSE (checkOptions ({}));
  expectRange (&Options::neighbors, &NeighborOptions::k, {6, 20, 200}, {5, 0, -1, 201});
  expectDiscRange (&DiscOptions::boundary, &BoundaryOptions::opening_angle, {1e-3, 160.0, 359.9},
                   {0.0, -10.0, 360.0, NO_NUMBER, INF});
  expectDiscRange (&DiscOptions::boundary, &BoundaryOptions::cluster_tolerance, {1e-6, 0.05, 1.0},
                   {0.0, -0.1, 1.01, NO_NUMBER});
  expectDiscRange (&DiscOptions::boundary, &BoundaryOptions::cluster_k, {1, 10}, {0, -3});
  expectDiscRange (&DiscOptions::domain, &DomainOptions::polygon_sides, {3, 100}, {2, 0, -1});
  expectRange (&Options::neighbors, &NeighborOptions::ball_radius, {1.0, 2.25, 10.0},
               {0.99, 10.1, NO_NUMBER, INF});
  expectDiscRange (&DiscOptions::solver, &SolverOptions::tolerance, {1e-16, 1e-3},
                   {0.0, -1e-9, 1.0, NO_NUMBER});
  expectDiscRange (&DiscOptions::solver, &SolverOptions::max_iterations, {1, 1000000}, {0, -1});
  expectDiscRange (&DiscOptions::solver, &SolverOptions::ilut_fill, {1, 15, 10000}, {0, -1, 10001});
  expectDiscRange (&DiscOptions::solver, &SolverOptions::ilut_drop, {0.0, 1e-2, 1.0},
                   {-1e-9, 1.1, NO_NUMBER});
  expectRange (&Options::threads, {0, 1, 64}, {-1});
  expectRange (&Options::blocks, {0, 1, 64}, {-1});
  expectRange (&Options::holes, &HoleOptions::kept_loops, {0, 1, 1000}, {-1});
  expectRange (&Options::holes, &HoleOptions::largest_hole, {0.0, 1e-20, 5.5, 1e20},
               {-1e-9, NO_NUMBER, INF});
  expectRange (&Options::trimming, &TrimmingOptions::maximum_edge_length, {0.0, 1e-20, 1e20},
               {-1e-9, NO_NUMBER, INF});
  expectRange (&Options::trimming, &TrimmingOptions::maximum_edge_ratio, {0.0, 0.5, 1e6},
               {-1e-9, NO_NUMBER, INF});
  expectRange (&Options::trimming, &TrimmingOptions::minimum_component_size, {0, 1, 1000000}, {-1});
}

TEST (CheckOptions, PoliciesFitTheTopology)
{
  for (const Topology topology : {Topology::AUTO, Topology::DISC, Topology::SURFACE})
    for (const HolePolicy holes :
         {HolePolicy::AUTO, HolePolicy::CLOSE_ALL, HolePolicy::KEEP_LARGEST, HolePolicy::KEEP_COUNT,
          HolePolicy::BY_SIZE}) {
      Options options;
      options.topology = topology;
      options.holes.policy = holes;
      options.holes.largest_hole = 3.0;
      const bool fits = topology != Topology::DISC || holes == HolePolicy::AUTO ||
                        holes == HolePolicy::KEEP_LARGEST;
      EXPECT_EQ (checkOptions (options).status,
                 fits ? RunStatus::SUCCESS : RunStatus::INVALID_OPTION);
      options.holes.unit = LengthUnit::CLOUD;
      EXPECT_EQ (checkOptions (options).status,
                 fits ? RunStatus::SUCCESS : RunStatus::INVALID_OPTION);
      // Only one policy needs a size.
      options.holes.largest_hole = 0.0;
      const bool fits_still = fits && holes != HolePolicy::BY_SIZE;
      EXPECT_EQ (checkOptions (options).status,
                 fits_still ? RunStatus::SUCCESS : RunStatus::INVALID_OPTION);
    }
}

TEST (CheckOptions, AViewpointIsFiniteAndNotOfADisc)
{
  Options options;
  options.view.viewpoint = {0.0, NO_NUMBER, 0.0};
  EXPECT_FALSE (checkOptions (options)); // not used
  options.view.use = ViewUse::GIVEN;
  EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_OPTION);
  options.view.viewpoint = {0.0, INF, 0.0};
  EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_OPTION);
  options.view.viewpoint = {};
  EXPECT_FALSE (checkOptions (options));
  options.topology = Topology::DISC;
  EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_OPTION);
}

TEST (CheckOptions, AGivenLoopIsOfADisc)
{
  Options options;
  options.disc.boundary.loop = {1, 2, 3};
  EXPECT_FALSE (checkOptions (options));
  options.topology = Topology::DISC;
  EXPECT_FALSE (checkOptions (options));
  options.topology = Topology::SURFACE;
  EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_OPTION);
}

TEST (CheckOptions, ALoopHasThreePoints)
{
  Options options;
  for (const std::vector<Index>& loop : {std::vector<Index>{1}, std::vector<Index>{1, 2}}) {
    options.disc.boundary.loop = loop;
    EXPECT_EQ (checkOptions (options).status, RunStatus::INVALID_LOOP);
  }
  options.disc.boundary.loop = {1, 2, 3};
  EXPECT_FALSE (checkOptions (options));
}

} // namespace
} // namespace pcl::floater
