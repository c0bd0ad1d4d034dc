// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/ordering.h"

#include "floater/grid_system.h"
#include "floater/solvers/solver.h"
#include "floater/solvers/umfpack_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl::floater {
namespace {
constexpr Ordering SYMMETRIC_ORDERINGS[] = {Ordering::AMD, Ordering::METIS, Ordering::NATURAL,
                                            Ordering::REVERSE_CUTHILL_MCKEE};

int
bandwidth (const LinearSystem& system)
{
  int widest = 0;
  for (std::size_t i = 0; i < system.unknowns (); ++i)
    for (int at = system.row_offsets[i]; at < system.row_offsets[i + 1]; ++at)
      widest = std::max (
          widest, std::abs (static_cast<int> (i) - system.columns[static_cast<std::size_t> (at)]));
  return widest;
}

TEST (UnknownOrder, ArePermutations)
{
  const TriangulatedGrid grid (20, 0.12, 11);
  const LinearSystem system = gridSystem (grid, Weighting::MEAN_VALUE);
  for (const Ordering ordering : SYMMETRIC_ORDERINGS) {
    std::vector<int> order = orderUnknowns (system, ordering);
    ASSERT_EQ (order.size (), system.unknowns ());
    EXPECT_EQ (std::is_sorted (order.begin (), order.end ()), ordering == Ordering::NATURAL);
    std::sort (order.begin (), order.end ());
    for (std::size_t i = 0; i < order.size (); ++i)
      ASSERT_EQ (order[i], static_cast<int> (i));
  }
  EXPECT_THROW (orderUnknowns (system, Ordering::COLAMD), std::invalid_argument);
}

// Ten thousand points, in a random numbering. Other solvers take these orders as they are, so they
// must be as good as UMFPACK's own.
TEST (UnknownOrder, FillAsLittleAsUmfpacksOwn)
{
  const TriangulatedGrid grid (102, 0.12, 16);
  const LinearSystem sorted = gridSystem (grid, Weighting::MEAN_VALUE);
  ASSERT_EQ (sorted.unknowns (), 10000U);
  const LinearSystem system = permuteSystem (sorted, randomOrder (sorted.unknowns (), 17));
  for (const Ordering ordering : {Ordering::AMD, Ordering::METIS}) {
    const auto own = static_cast<double> (solveWithUmfpack (system, ordering, 1).nnz_factors);
    const std::vector<int> order = orderUnknowns (system, ordering);
    const auto fill = static_cast<double> (solveWithUmfpack (system, order, 1).nnz_factors);
    const LinearSystem permuted = permuteSystem (system, order);
    SolverOptions as_it_is;
    as_it_is.method = Solver::EIGEN_SPARSE_LU;
    as_it_is.ordering = Ordering::NATURAL;
    const auto by_eigen = static_cast<double> (solve (permuted, as_it_is, nullptr, 1).nnz_factors);
    EXPECT_NEAR (fill / own, 1.0, 0.03) << static_cast<int> (ordering);
    EXPECT_NEAR (by_eigen / own, 1.0, 0.03) << static_cast<int> (ordering);
    RecordProperty (ordering == Ordering::AMD ? "amd" : "metis", std::to_string (fill / own));
  }
}

TEST (UnknownOrder, OfNoUnknownsAndOfUnknownsWithoutNeighbors)
{
  LinearSystem system;
  system.row_offsets = {0};
  for (const Ordering ordering : SYMMETRIC_ORDERINGS)
    EXPECT_TRUE (orderUnknowns (system, ordering).empty ());
  for (int i = 0; i < 3; ++i) {
    system.point_of_unknown.push_back (static_cast<Index> (i));
    system.columns.push_back (i);
    system.values.push_back (1.0);
    system.row_offsets.push_back (i + 1);
  }
  for (const Ordering ordering : SYMMETRIC_ORDERINGS) {
    std::vector<int> order = orderUnknowns (system, ordering);
    std::sort (order.begin (), order.end ());
    EXPECT_EQ (order, (std::vector<int>{0, 1, 2}));
  }
}

TEST (UnknownOrder, ReverseCuthillMckeeNarrowsTheBand)
{
  const TriangulatedGrid grid (30, 0.12, 12);
  const LinearSystem narrow = gridSystem (grid, Weighting::MEAN_VALUE); // bandwidth 29
  const LinearSystem wide = permuteSystem (narrow, randomOrder (narrow.unknowns (), 13));
  EXPECT_GT (bandwidth (wide), 500);
  EXPECT_LT (bandwidth (permuteSystem (wide, reverseCuthillMckee (wide))), 60);
}

TEST (UnknownOrder, PermutingMovesRowsColumnsAndRightHandSides)
{
  const TriangulatedGrid grid (9, 0.12, 14);
  const LinearSystem system = gridSystem (grid, Weighting::SHAPE_PRESERVING);
  const std::vector<int> order = randomOrder (system.unknowns (), 15);
  const LinearSystem permuted = permuteSystem (system, order);
  const auto value = [] (const LinearSystem& of, std::size_t row, int column) {
    for (int at = of.row_offsets[row]; at < of.row_offsets[row + 1]; ++at)
      if (of.columns[static_cast<std::size_t> (at)] == column)
        return of.values[static_cast<std::size_t> (at)];
    return 0.0;
  };
  EXPECT_EQ (permuted.nonzeros (), system.nonzeros ());
  for (std::size_t i = 0; i < system.unknowns (); ++i) {
    const auto from = static_cast<std::size_t> (order[i]);
    EXPECT_EQ (permuted.rhs_u[i], system.rhs_u[from]);
    EXPECT_EQ (permuted.rhs_v[i], system.rhs_v[from]);
    EXPECT_EQ (permuted.point_of_unknown[i], system.point_of_unknown[from]);
    EXPECT_EQ (permuted.unknown_of_point[permuted.point_of_unknown[i]], i);
    EXPECT_TRUE (std::is_sorted (permuted.columns.begin () + permuted.row_offsets[i],
                                 permuted.columns.begin () + permuted.row_offsets[i + 1]));
    for (std::size_t j = 0; j < system.unknowns (); ++j)
      ASSERT_EQ (value (permuted, i, static_cast<int> (j)), value (system, from, order[j]));
  }
}

} // namespace
} // namespace pcl::floater
