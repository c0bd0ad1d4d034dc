// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/linear_system.h"

#include "floater/weights.h"
#include "random_stream.h"
#include "triangulated_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace pcl::floater {
namespace {
using Ids = std::vector<Index>;

TEST (LinearSystem, WithTwoUnknowns)
{
  // Points 1 and 3 are unknowns, 0, 2 and 5 are the loop, and 4 is left out.
  CsrLists neighbors;
  neighbors.offsets = {0, 1, 5, 5, 9, 10, 10};
  neighbors.ids = {1, /* 1: */ 3, 0, 4, 2, /* 3: */ 5, 2, 1, 4, /* 4: */ 3};
  const std::vector<double> weights{1.0, 0.5, 0.125, 0.25, 0.125, 0.125, 0.25, 0.375, 0.25, 1.0};
  const std::vector<Eigen::Vector2d> loop_uv{{8.0, 0.0}, {0.0, 16.0}, {-32.0, 0.0}};
  const LinearSystem system =
      assembleSystem (neighbors, weights, {0, 2, 5}, loop_uv, {1, 1, 1, 1, 0, 1}, 1);
  EXPECT_EQ (system.point_of_unknown, (Ids{1, 3}));
  EXPECT_EQ (system.unknown_of_point, (Ids{NONE, 0, NONE, 1, NONE, NONE}));
  EXPECT_EQ (system.row_offsets, (std::vector<int>{0, 2, 4}));
  EXPECT_EQ (system.columns, (std::vector<int>{0, 1, 0, 1}));
  // The diagonal contains the weights of the loop, but not those of point 4.
  EXPECT_EQ (system.values, (std::vector<double>{0.75, -0.5, -0.375, 0.75}));
  EXPECT_EQ (system.rhs_u, (std::vector<double>{1.0, -4.0}));
  EXPECT_EQ (system.rhs_v, (std::vector<double>{2.0, 4.0}));
}

// A system of as many entries as there may be is made, and none of more.
TEST (LinearSystem, OfTooManyEntriesIsRefused)
{
  CsrLists neighbors;
  neighbors.offsets = {0, 0, 2, 4, 4};
  neighbors.ids = {0, 2, 1, 3};
  const std::vector<double> weights (4, 0.5);
  const auto assemble = [&] (std::size_t most) {
    return assembleSystem (neighbors, weights, {0, 3}, {{0.0, 0.0}, {1.0, 0.0}}, {1, 1, 1, 1}, 1,
                           most);
  };
  EXPECT_EQ (assemble (4).nonzeros (), 4U);
  EXPECT_THROW (assemble (3), IndexLimitReached);
}

// Compared with a dense matrix, entry by entry.
TEST (LinearSystem, OfASheetWithPointsLeftOut)
{
  const TriangulatedGrid grid (12, 0.1, 1);
  const std::vector<double> weights = computeWeights (grid.stars, Weighting::MEAN_VALUE, 1);
  const std::size_t count = grid.positions.size ();
  RandomStream random (2);
  std::vector<std::uint8_t> reachable (count);
  for (auto& flag : reachable)
    flag = random.uniform () < 0.8 ? 1 : 0;
  std::vector<Eigen::Vector2d> loop_uv;
  for (const Index p : grid.loop) {
    reachable[p] = 1;
    loop_uv.emplace_back (random.uniform (), random.uniform ());
  }
  const LinearSystem system =
      assembleSystem (grid.stars.neighbors, weights, grid.loop, loop_uv, reachable, 1);

  ASSERT_EQ (system.unknown_of_point.size (), count);
  ASSERT_EQ (system.row_offsets.size (), system.unknowns () + 1);
  ASSERT_TRUE (std::is_sorted (system.point_of_unknown.begin (), system.point_of_unknown.end ()));
  for (std::size_t p = 0; p < count; ++p) {
    const bool on_loop = std::count (grid.loop.begin (), grid.loop.end (), p) > 0;
    const Index i = system.unknown_of_point[p];
    ASSERT_EQ (i != NONE, reachable[p] != 0 && !on_loop);
    if (i == NONE)
      continue;
    ASSERT_EQ (system.point_of_unknown[i], p);
    Eigen::VectorXd row = Eigen::VectorXd::Zero (static_cast<Eigen::Index> (system.unknowns ()));
    Eigen::Vector2d rhs = Eigen::Vector2d::Zero ();
    for (Index entry = grid.stars.neighbors.offsets[p]; entry < grid.stars.neighbors.offsets[p + 1];
         ++entry) {
      const Index q = grid.stars.neighbors.ids[entry];
      const auto place = std::find (grid.loop.begin (), grid.loop.end (), q);
      if (reachable[q] == 0)
        continue;
      row[i] += weights[entry];
      if (place == grid.loop.end ())
        row[system.unknown_of_point[q]] -= weights[entry];
      else
        rhs += weights[entry] * loop_uv[static_cast<std::size_t> (place - grid.loop.begin ())];
    }
    int previous = -1;
    for (int entry = system.row_offsets[i]; entry < system.row_offsets[i + 1]; ++entry) {
      const int column = system.columns[static_cast<std::size_t> (entry)];
      EXPECT_LT (previous, column);
      previous = column;
      EXPECT_DOUBLE_EQ (system.values[static_cast<std::size_t> (entry)], row[column]);
      row[column] = 0.0;
    }
    EXPECT_EQ (row.cwiseAbs ().maxCoeff (), 0.0) << "an entry is missing";
    EXPECT_DOUBLE_EQ (system.rhs_u[i], rhs.x ());
    EXPECT_DOUBLE_EQ (system.rhs_v[i], rhs.y ());
  }
}

TEST (LinearSystem, DoesNotDependOnTheThreads)
{
  const TriangulatedGrid grid (60, 0.12, 3);
  const std::vector<double> weights = computeWeights (grid.stars, Weighting::MEAN_VALUE, 1);
  const std::vector<std::uint8_t> reachable (grid.positions.size (), 1);
  const auto assemble = [&] (int threads) {
    return assembleSystem (grid.stars.neighbors, weights, grid.loop, grid.loopInPlace (), reachable,
                           threads);
  };
  const LinearSystem one = assemble (1), three = assemble (3);
  EXPECT_EQ (one.columns, three.columns);
  EXPECT_EQ (one.values, three.values);
  EXPECT_EQ (one.rhs_u, three.rhs_u);
  EXPECT_EQ (one.rhs_v, three.rhs_v);
}

TEST (LinearSystem, OfALoopAloneIsEmpty)
{
  CsrLists neighbors;
  neighbors.offsets = {0, 2, 4, 6};
  neighbors.ids = {1, 2, 0, 2, 0, 1};
  const LinearSystem system = assembleSystem (neighbors, std::vector<double> (6, 0.5), {0, 1, 2},
                                              {{0, 0}, {1, 0}, {0, 1}}, {1, 1, 1}, 2);
  EXPECT_EQ (system.unknowns (), 0u);
  EXPECT_EQ (system.nonzeros (), 0u);
  EXPECT_EQ (system.row_offsets, std::vector<int>{0});
}

TEST (LinearSystem, KeepsRowsWithoutNeighbors)
{
  CsrLists neighbors;
  neighbors.offsets = {0, 0, 0, 0, 0};
  const LinearSystem system =
      assembleSystem (neighbors, {}, {0, 1, 2}, {{0, 0}, {1, 0}, {0, 1}}, {1, 1, 1, 1}, 1);
  EXPECT_EQ (system.columns, std::vector<int>{0});
  EXPECT_EQ (system.values, std::vector<double>{0.0});
}

} // namespace
} // namespace pcl::floater
