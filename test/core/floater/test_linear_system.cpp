// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/grid_system.h"

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
      assembleSystem (neighbors, weights, {0, 2, 5}, loop_uv, {1, 1, 1, 1, 0, 1});
  EXPECT_EQ (system.point_of_unknown, (Ids{1, 3}));
  EXPECT_EQ (system.unknown_of_point, (Ids{NONE, 0, NONE, 1, NONE, NONE}));
  EXPECT_EQ (system.row_offsets, (std::vector<int>{0, 2, 4}));
  EXPECT_EQ (system.columns, (std::vector<int>{0, 1, 0, 1}));
  // The diagonal contains the weights of the loop, but not those of point 4.
  EXPECT_EQ (system.values, (std::vector<double>{0.75, -0.5, -0.375, 0.75}));
  EXPECT_EQ (system.rhs, (Eigen::Matrix2d{{1.0, 2.0}, {-4.0, 4.0}}));
}

// A system of as many entries as there may be is made, and none of more.
TEST (LinearSystem, OfTooManyEntriesIsRefused)
{
  CsrLists neighbors;
  neighbors.offsets = {0, 0, 2, 4, 4};
  neighbors.ids = {0, 2, 1, 3};
  const std::vector<double> weights (4, 0.5);
  const auto assemble = [&] (std::size_t most) {
    return assembleSystem (neighbors, weights, {0, 3}, {{0.0, 0.0}, {1.0, 0.0}}, {1, 1, 1, 1},
                           most);
  };
  EXPECT_EQ (assemble (4).nonzeros (), 4U);
  EXPECT_THROW (assemble (3), IndexLimitReached);
}

// Compared with a dense matrix.
TEST (LinearSystem, OfASheetWithPointsLeftOut)
{
  const TriangulatedGrid grid (20, 0.1, 1);
  const CsrLists& neighbors = grid.stars.neighbors;
  const std::vector<double> weights = computeWeights (grid.stars, Weighting::MEAN_VALUE, 1);
  const std::size_t count = grid.positions.size ();
  RandomStream random (2);
  std::vector<std::uint8_t> reachable (count);
  for (auto& flag : reachable)
    flag = random.uniform () < 0.8 ? 1 : 0;
  std::vector<Eigen::Vector2d> loop_uv;
  Ids expected_unknowns, place (count, NONE);
  for (const Index p : grid.loop) {
    reachable[p] = 1;
    place[p] = static_cast<Index> (loop_uv.size ());
    loop_uv.emplace_back (random.uniform (), random.uniform ());
  }
  for (Index p = 0; p < count; ++p)
    if (reachable[p] != 0 && place[p] == NONE)
      expected_unknowns.push_back (p);
  const LinearSystem system = assembleSystem (neighbors, weights, grid.loop, loop_uv, reachable);
  ASSERT_EQ (system.point_of_unknown, expected_unknowns);
  const auto n = static_cast<Eigen::Index> (system.unknowns ());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero (n, n);
  Eigen::MatrixX2d rhs = Eigen::MatrixX2d::Zero (n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Index p = system.point_of_unknown[static_cast<std::size_t> (i)];
    ASSERT_EQ (system.unknown_of_point[p], i);
    for (Index entry = neighbors.offsets[p]; entry < neighbors.offsets[p + 1]; ++entry) {
      const Index q = neighbors.ids[entry];
      if (reachable[q] == 0)
        continue;
      dense (i, i) += weights[entry];
      if (place[q] == NONE)
        dense (i, system.unknown_of_point[q]) -= weights[entry];
      else
        rhs.row (i) += weights[entry] * loop_uv[place[q]].transpose ();
    }
  }
  EXPECT_LT ((denseMatrix (system) - dense).cwiseAbs ().maxCoeff (), 1e-15);
  EXPECT_LT ((system.rhs - rhs).cwiseAbs ().maxCoeff (), 1e-15);
  for (std::size_t i = 0; i < system.unknowns (); ++i)
    EXPECT_TRUE (std::is_sorted (system.columns.begin () + system.row_offsets[i],
                                 system.columns.begin () + system.row_offsets[i + 1]));
}

// A triangle of loop points alone, and with one point that has no neighbours.
TEST (LinearSystem, WithoutEquationsOrNeighbors)
{
  const std::vector<Eigen::Vector2d> loop_uv{{0, 0}, {1, 0}, {0, 1}};
  CsrLists neighbors;
  neighbors.offsets = {0, 2, 4, 6};
  neighbors.ids = {1, 2, 0, 2, 0, 1};
  const std::vector<double> weights (6, 0.5);
  const LinearSystem empty = assembleSystem (neighbors, weights, {0, 1, 2}, loop_uv, {1, 1, 1});
  EXPECT_EQ (empty.unknowns (), 0U);
  EXPECT_EQ (empty.nonzeros (), 0U);
  neighbors.offsets.push_back (6);
  const LinearSystem one = assembleSystem (neighbors, weights, {0, 1, 2}, loop_uv, {1, 1, 1, 1});
  EXPECT_EQ (one.columns, std::vector<int>{0});
  EXPECT_EQ (one.values, std::vector<double>{0.0});
}

} // namespace
} // namespace pcl::floater
