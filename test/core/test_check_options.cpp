// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_options.h"

#include "samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pcl
{
namespace floater
{
namespace
{
using samples::Positions;

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN ();

template <typename Value>
void
expectRange (Value Options::*option, std::initializer_list<Value> good,
             std::initializer_list<Value> bad)
{
  Options options;
  for (const Value value : good) {
    options.*option = value;
    EXPECT_FALSE (checkOptions (options)) << value;
  }
  for (const Value value : bad) {
    options.*option = value;
    const Problem problem = checkOptions (options);
    EXPECT_EQ (problem.status, Status::INVALID_OPTION) << value;
    EXPECT_FALSE (problem.message.empty ());
  }
}

TEST (Validation, OptionsHaveRanges)
{
  constexpr double INF = std::numeric_limits<double>::infinity ();
  EXPECT_FALSE (checkOptions ({}));
  expectRange (&Options::k, {6, 20, 200}, {5, 0, -1, 201});
  expectRange (&Options::opening_angle, {1e-3, 160.0, 359.9},
               {0.0, -10.0, 360.0, NOT_A_NUMBER, INF});
  expectRange (&Options::cluster_tolerance, {1e-6, 0.05, 1.0}, {0.0, -0.1, 1.01, NOT_A_NUMBER});
  expectRange (&Options::cluster_k, {1, 10}, {0, -3});
  expectRange (&Options::polygon_sides, {3, 100}, {2, 0, -1});
  expectRange (&Options::ball_radius, {1.0, 2.25, 10.0}, {0.99, 10.1, NOT_A_NUMBER, INF});
  expectRange (&Options::tolerance, {1e-16, 1e-3}, {0.0, -1e-9, 1.0, NOT_A_NUMBER});
  expectRange (&Options::max_iterations, {1, 1000000}, {0, -1});
  expectRange (&Options::ilut_fill, {1, 15, 10000}, {0, -1, 10001});
  expectRange (&Options::ilut_drop, {0.0, 1e-2, 1.0}, {-1e-9, 1.1, NOT_A_NUMBER});
  expectRange (&Options::threads, {0, 1, 64}, {-1});
  expectRange (&Options::blocks, {0, 1, 64}, {-1});
  expectRange (&Options::kept_loops, {0, 1, 1000}, {-1});
  expectRange (&Options::largest_hole, {0.0, 5.5, 1e6}, {-1e-9, NOT_A_NUMBER, INF});
  expectRange (&Options::largest_hole_length, {0.0, 1e-20, 1e20}, {-1e-9, NOT_A_NUMBER, INF});
}

TEST (Validation, PoliciesFitTheTopology)
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
      EXPECT_EQ (checkOptions (options).status, fits ? Status::OK : Status::INVALID_OPTION);
      // A size is needed by one policy alone, in either unit.
      options.holes.largest_hole = 0.0;
      const bool fits_still = fits && holes != HolePolicy::BY_SIZE;
      EXPECT_EQ (checkOptions (options).status, fits_still ? Status::OK : Status::INVALID_OPTION);
      options.holes.largest_hole_length = 0.1;
      EXPECT_EQ (checkOptions (options).status, fits ? Status::OK : Status::INVALID_OPTION);
    }
}

TEST (Validation, AGivenLoopIsOfADisc)
{
  Options options;
  options.boundary.loop = {1, 2, 3};
  EXPECT_FALSE (checkOptions (options));
  options.topology = Topology::DISC;
  EXPECT_FALSE (checkOptions (options));
  options.topology = Topology::SURFACE;
  EXPECT_EQ (checkOptions (options).status, Status::INVALID_OPTION);
}

TEST (Validation, ALoopHasThreePoints)
{
  Options options;
  for (const std::vector<Index>& loop : {std::vector<Index>{1}, std::vector<Index>{1, 2}}) {
    options.boundary.loop = loop;
    EXPECT_EQ (checkOptions (options).status, Status::INVALID_LOOP);
  }
  options.boundary.loop = {1, 2, 3};
  EXPECT_FALSE (checkOptions (options));
}

Status
statusOf (const Positions& positions)
{
  return checkPoints (makePoints (positions, samples::indices (positions.size ()), 1)).status;
}

TEST (Validation, FourDistinctFinitePoints)
{
  const Positions square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ (statusOf (square), Status::OK);
  EXPECT_EQ (statusOf ({}), Status::TOO_FEW_POINTS);
  EXPECT_EQ (statusOf ({square[0], square[1], square[2]}), Status::TOO_FEW_POINTS);
  EXPECT_EQ (statusOf ({square[0], square[1], square[2], square[1], square[0]}),
             Status::TOO_FEW_POINTS);
  EXPECT_EQ (statusOf ({square[0], square[1], square[2], {0, NOT_A_NUMBER, 0}}),
             Status::TOO_FEW_POINTS);
}

TEST (Validation, NotAllOnOneLine)
{
  for (const double scale : {1e-20, 1.0, 1e20}) {
    Positions line;
    for (int i = 0; i < 30; ++i) // rounded to single precision, as clouds are
      line.emplace_back (static_cast<float> (scale * 0.1 * i), static_cast<float> (scale * 0.3 * i),
                         static_cast<float> (scale * -0.7 * i));
    EXPECT_EQ (statusOf (line), Status::DEGENERATE);
    line.emplace_back (scale * 0.01, 0.0, 0.0);
    EXPECT_EQ (statusOf (line), Status::OK);
  }
}

// Two rings of a wheel: vertex 0, ring 1 to 6, ring 7 to 12.
std::vector<Triangle>
wheel (bool with_middle)
{
  std::vector<Triangle> triangles;
  for (Index i = 0; i < 6; ++i) {
    const Index j = (i + 1) % 6;
    if (with_middle)
      triangles.push_back ({0, 1 + i, 1 + j});
    triangles.push_back ({1 + i, 7 + i, 7 + j});
    triangles.push_back ({1 + i, 7 + j, 1 + j});
  }
  return triangles;
}

const std::vector<Index> RIM = {7, 8, 9, 10, 11, 12};

TEST (Validation, ADiscInItsLoop)
{
  EXPECT_FALSE (checkDisc (wheel (true), 13, RIM));
  // The loop may begin anywhere and run the other way round; points without triangle are no matter.
  EXPECT_FALSE (checkDisc (wheel (true), 20, {9, 8, 7, 12, 11, 10}));
}

TEST (Validation, WhatIsNoDiscInItsLoop)
{
  const auto expectBroken = [] (const char* why, const std::vector<Triangle>& triangles,
                                const std::vector<Index>& loop) {
    const Problem problem = checkDisc (triangles, 30, loop);
    EXPECT_EQ (problem.status, Status::INTERNAL_ERROR) << why;
    EXPECT_FALSE (problem.message.empty ()) << why;
  };
  expectBroken ("nothing", {}, RIM);
  expectBroken ("a hole", wheel (false), RIM);
  expectBroken ("another loop", wheel (true), {7, 8, 9, 10, 11});
  expectBroken ("a loop inside", wheel (true), {1, 2, 3, 4, 5, 6});
  expectBroken ("another order", wheel (true), {7, 9, 8, 10, 11, 12});
  // Euler characteristic and loops are those of a disc.
  std::vector<Triangle> beside_a_torus = wheel (true);
  const auto onTorus = [] (Index i, Index j) { return 13 + 3 * (i % 3) + j % 3; };
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) {
      beside_a_torus.push_back ({onTorus (i, j), onTorus (i + 1, j), onTorus (i + 1, j + 1)});
      beside_a_torus.push_back ({onTorus (i, j), onTorus (i + 1, j + 1), onTorus (i, j + 1)});
    }
  expectBroken ("a torus beside it", beside_a_torus, RIM);
  std::vector<Triangle> changed = wheel (true);
  changed.push_back ({20, 21, 22});
  expectBroken ("two components", changed, RIM);
  changed = wheel (true);
  for (const Triangle& t :
       {Triangle{20, 22, 21}, Triangle{20, 21, 23}, Triangle{21, 22, 23}, Triangle{22, 20, 23}})
    changed.push_back (t);
  expectBroken ("a closed component", changed, RIM);
  changed = wheel (true);
  std::swap (changed[3][0], changed[3][1]);
  expectBroken ("a triangle wound against the others", changed, RIM);
  changed = wheel (true);
  changed.push_back (changed[4]);
  expectBroken ("a triangle twice", changed, RIM);
  changed = wheel (true);
  changed.push_back ({0, 20, 21});
  expectBroken ("a vertex with two fans", changed, RIM);
  changed = wheel (true);
  changed.pop_back ();
  expectBroken ("a triangle less", changed, RIM);
}

} // namespace
} // namespace floater
} // namespace pcl
