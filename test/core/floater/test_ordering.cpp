// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/grid_system.h"
#include "floater/solvers/solver_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace pcl::floater {
namespace {
constexpr Ordering MADE_ORDERINGS[] = {Ordering::AMD, Ordering::METIS,
                                       Ordering::REVERSE_CUTHILL_MCKEE};

int
bandwidth (const LinearSystem& system)
{
  int widest = 0;
  for (std::size_t i = 0; i < system.unknowns (); ++i)
    system.visitRow (i, [&] (std::size_t j, double) {
      widest = std::max (widest, std::abs (static_cast<int> (i) - static_cast<int> (j)));
    });
  return widest;
}

void
expectPermutation (std::vector<int> order, std::size_t count)
{
  std::sort (order.begin (), order.end ());
  ASSERT_EQ (order.size (), count);
  for (std::size_t i = 0; i < count; ++i)
    ASSERT_EQ (order[i], static_cast<int> (i));
}

TEST (UnknownOrder, IsAPermutation)
{
  const TriangulatedGrid grid (20, 0.12, 11);
  LinearSystem apart; // no unknown has a neighbour
  for (int i = 0; i < 3; ++i) {
    std::vector<std::pair<int, double>> row{{i, 1.0}};
    apart.addRow (row);
  }
  const LinearSystem joined = gridSystem (grid);
  for (const Ordering ordering : MADE_ORDERINGS)
    for (const LinearSystem& system : {joined, apart})
      expectPermutation (orderUnknowns (system, ordering), system.unknowns ());
}

TEST (UnknownOrder, ReverseCuthillMckeeNarrowsTheBand)
{
  const TriangulatedGrid grid (30, 0.12, 12);
  const LinearSystem narrow = gridSystem (grid); // bandwidth 29
  const LinearSystem wide = permuteSystem (narrow, randomOrder (narrow.unknowns (), 13));
  const auto banded = [] (const LinearSystem& system) {
    return bandwidth (
        permuteSystem (system, orderUnknowns (system, Ordering::REVERSE_CUTHILL_MCKEE)));
  };
  EXPECT_GT (bandwidth (wide), 500);
  EXPECT_LT (banded (wide), 40);
  LinearSystem path; // if A^T is added; the matrix itself has one side only
  constexpr int LENGTH = 200;
  path.rhs.setZero (LENGTH, 2);
  for (int i = 0; i < LENGTH; ++i) {
    std::vector<std::pair<int, double>> row{{i, 1.0}, {(i + 1) % LENGTH, -1.0}};
    row.resize (i + 1 < LENGTH ? 2 : 1);
    path.addRow (row);
  }
  EXPECT_EQ (banded (permuteSystem (path, randomOrder (LENGTH, 18))), 1);
}

TEST (UnknownOrder, ByMetisIsTheSameAndLeavesRandomNumbersAlone)
{
  const TriangulatedGrid grid (60, 0.12, 19);
  const LinearSystem system = gridSystem (grid);
  std::srand (7);
  const std::vector<int> expected = orderUnknowns (system, Ordering::METIS);
  const int first = std::rand ();
  EXPECT_EQ (orderUnknowns (system, Ordering::METIS), expected);
  const int second = std::rand ();
  std::srand (7);
  EXPECT_EQ (std::rand (), first);
  EXPECT_EQ (std::rand (), second);
}

TEST (UnknownOrder, PermutingMovesRowsColumnsAndRightHandSides)
{
  const TriangulatedGrid grid (9, 0.12, 14);
  const LinearSystem system = gridSystem (grid, Weighting::SHAPE_PRESERVING);
  const std::vector<int> order = randomOrder (system.unknowns (), 15);
  const LinearSystem permuted = permuteSystem (system, order);
  const Eigen::MatrixXd dense = denseMatrix (system), moved = denseMatrix (permuted);
  for (std::size_t i = 0; i < system.unknowns (); ++i) {
    const auto row = static_cast<Eigen::Index> (i);
    EXPECT_EQ (permuted.rhs.row (row), system.rhs.row (order[i]));
    EXPECT_TRUE (std::is_sorted (permuted.columns.begin () + permuted.row_offsets[i],
                                 permuted.columns.begin () + permuted.row_offsets[i + 1]));
    for (std::size_t j = 0; j < system.unknowns (); ++j)
      ASSERT_EQ (moved (row, static_cast<Eigen::Index> (j)), dense (order[i], order[j]));
  }
}

} // namespace
} // namespace pcl::floater
