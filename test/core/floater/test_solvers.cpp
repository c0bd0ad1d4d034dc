// SPDX-License-Identifier: GPL-3.0-or-later
// All solvers in all orders, on systems whose solution is known.
#include "floater/solvers/solver.h"

#include "floater/solvers/islands.h"
#include "floater/solvers/ordering.h"
#include "floater/solvers/residual.h"
#include "floater/weights.h"
#include "triangulated_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl
{
namespace floater
{
namespace
{
using Outcome = Solution::Outcome;

constexpr Solver ALL_SOLVERS[] = {Solver::UMFPACK,       Solver::UMFPACK_UNSYMMETRIC,
                                  Solver::SUPERLU,       Solver::EIGEN_SPARSE_LU,
                                  Solver::BICGSTAB_ILUT, Solver::GAUSS_SEIDEL};
constexpr Ordering ALL_ORDERINGS[] = {Ordering::AUTOMATIC, Ordering::AMD,
                                      Ordering::METIS,     Ordering::COLAMD,
                                      Ordering::NATURAL,   Ordering::REVERSE_CUTHILL_MCKEE};
constexpr Ordering SYMMETRIC_ORDERINGS[] = {Ordering::AMD, Ordering::METIS, Ordering::NATURAL,
                                            Ordering::REVERSE_CUTHILL_MCKEE};

bool
isIterative (Solver solver)
{
  return solver == Solver::BICGSTAB_ILUT || solver == Solver::GAUSS_SEIDEL;
}

Options
choice (Solver solver, Ordering ordering = Ordering::AUTOMATIC)
{
  Options options;
  options.solver.method = solver;
  options.solver.ordering = ordering;
  options.solver.max_iterations = 100000; // enough for Gauss-Seidel on what is solved here
  return options;
}

LinearSystem
systemOf (const TriangulatedGrid& grid, Weighting weighting)
{
  return assembleSystem (grid.stars.neighbors, computeWeights (grid.stars, weighting, 1), grid.loop,
                         grid.loopInPlace (), std::vector<std::uint8_t> (grid.positions.size (), 1),
                         1);
}

// All of it but the ties of the last unknowns to the rest and to the loop.
void
cutOff (std::size_t island, LinearSystem& system)
{
  const std::size_t first = system.unknowns () - island;
  for (std::size_t i = first; i < system.unknowns (); ++i) {
    double sum = 0.0;
    std::size_t diagonal = 0;
    for (int at = system.row_offsets[i]; at < system.row_offsets[i + 1]; ++at) {
      const auto entry = static_cast<std::size_t> (at);
      const auto column = static_cast<std::size_t> (system.columns[entry]);
      if (column == i)
        diagonal = entry;
      else if (column < first)
        system.values[entry] = 0.0;
      else
        sum -= system.values[entry];
    }
    system.values[diagonal] = sum;
    system.rhs_u[i] = system.rhs_v[i] = 0.0;
  }
}

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

std::vector<int>
randomOrder (std::size_t count, std::uint64_t seed)
{
  std::vector<int> order (count);
  std::iota (order.begin (), order.end (), 0);
  RandomStream random (seed);
  for (std::size_t i = count; i > 1; --i)
    std::swap (order[i - 1], order[random.below (i)]);
  return order;
}

// A flat sheet in its own place: weights that reproduce linear functions have no other solution.
TEST (Solvers, ReproduceLinearFunctionsInEveryOrder)
{
  const TriangulatedGrid grid (14, 0.12, 1);
  for (const Weighting weighting : {Weighting::MEAN_VALUE, Weighting::SHAPE_PRESERVING}) {
    const LinearSystem system = systemOf (grid, weighting);
    for (const Solver solver : ALL_SOLVERS)
      for (const Ordering ordering : ALL_ORDERINGS) {
        if (checkSolver (solver, ordering))
          continue;
        SCOPED_TRACE (testing::Message () << "solver " << static_cast<int> (solver) << " ordering "
                                          << static_cast<int> (ordering));
        const Solution solution = solve (system, choice (solver, ordering));
        ASSERT_EQ (solution.outcome, Outcome::OK) << solution.message;
        ASSERT_EQ (solution.uv.size (), system.unknowns ());
        for (std::size_t i = 0; i < system.unknowns (); ++i) {
          const Eigen::Vector3d& position = grid.positions[system.point_of_unknown[i]];
          ASSERT_LT ((solution.uv[i] - position.head<2> ()).norm (), 1e-12) << i;
        }
        EXPECT_LT (solution.residual, 1e-14);
        EXPECT_LT (solution.relative_residual, 1e-14);
        if (isIterative (solver)) {
          EXPECT_GT (solution.iterations[0], 0U);
          EXPECT_GT (solution.iterations[1], 0U);
        }
        else {
          EXPECT_EQ (solution.iterations[0], 0U);
          EXPECT_GE (solution.nnz_factors, system.nonzeros ());
          EXPECT_GT (solution.reciprocal_condition,
                     solver == Solver::UMFPACK_UNSYMMETRIC ? 0.0 : 1e-3);
          EXPECT_LE (solution.reciprocal_condition, 1.0);
        }
      }
  }
}

TEST (Solvers, TakeTheOrderTheyAreGiven)
{
  const TriangulatedGrid grid (30, 0.12, 2);
  const LinearSystem grid_system = systemOf (grid, Weighting::MEAN_VALUE);
  const LinearSystem system = permuteSystem (grid_system, randomOrder (grid_system.unknowns (), 5));
  for (const Solver solver : ALL_SOLVERS) {
    if (!isAvailable (solver) || isIterative (solver))
      continue;
    SCOPED_TRACE (static_cast<int> (solver));
    const auto fill = [&] (Ordering ordering) {
      const Solution solution = solve (system, choice (solver, ordering));
      EXPECT_EQ (solution.outcome, Outcome::OK) << solution.message;
      return solution.nnz_factors;
    };
    const std::size_t natural = fill (Ordering::NATURAL);
    const std::size_t band = fill (Ordering::REVERSE_CUTHILL_MCKEE);
    EXPECT_GT (natural, 2 * band);
    EXPECT_GT (natural, 2 * fill (Ordering::AUTOMATIC));
    if (solver == Solver::UMFPACK_UNSYMMETRIC)
      continue; // goes through the rows in an order of its own
    EXPECT_GT (band, fill (Ordering::AMD));
    EXPECT_GT (band, fill (Ordering::METIS));
  }
}

TEST (Solvers, RefuseAnOrderOfColumnsAlone)
{
  LinearSystem system;
  system.row_offsets = {0};
  for (const Solver solver : {Solver::UMFPACK, Solver::BICGSTAB_ILUT, Solver::GAUSS_SEIDEL}) {
    const Problem problem = checkSolver (solver, Ordering::COLAMD);
    EXPECT_EQ (problem.status, Status::INVALID_OPTION);
    EXPECT_NE (problem.message.find ("COLAMD"), std::string::npos);
    EXPECT_EQ (solve (system, choice (solver, Ordering::COLAMD)).outcome, Outcome::FAILED);
  }
}

TEST (Solvers, TellIfTheyAreNotBuilt)
{
  for (const Solver solver : ALL_SOLVERS) {
    LinearSystem system;
    system.row_offsets = {0};
    const Problem problem = checkSolver (solver, Ordering::AUTOMATIC);
    const Solution solution = solve (system, choice (solver));
    EXPECT_EQ (problem.status, isAvailable (solver) ? Status::OK : Status::SOLVER_UNAVAILABLE);
    EXPECT_EQ (problem.message.empty (), isAvailable (solver));
    EXPECT_EQ (solution.outcome, isAvailable (solver) ? Outcome::OK : Outcome::UNAVAILABLE);
    EXPECT_EQ (solution.message, problem.message);
    EXPECT_TRUE (solver == Solver::SUPERLU || isAvailable (solver));
  }
}

TEST (Solvers, RefuseIslands)
{
  const TriangulatedGrid grid (16, 0.12, 3);
  for (const std::size_t island : {20, 50, 140}) {
    LinearSystem system = systemOf (grid, Weighting::MEAN_VALUE);
    cutOff (island, system);
    EXPECT_EQ (countFloatingUnknowns (system), island);
    for (const Solver solver : ALL_SOLVERS)
      for (const Ordering ordering : {Ordering::AUTOMATIC, Ordering::REVERSE_CUTHILL_MCKEE}) {
        if (!isAvailable (solver))
          continue;
        SCOPED_TRACE (testing::Message () << "solver " << static_cast<int> (solver) << " ordering "
                                          << static_cast<int> (ordering) << " island " << island);
        const Solution solution = solve (system, choice (solver, ordering));
        EXPECT_EQ (solution.outcome, Outcome::SINGULAR);
        EXPECT_FALSE (solution.message.empty ());
        EXPECT_TRUE (solution.uv.empty ());
      }
  }
}

TEST (Solvers, RefuseARowWithoutWeights)
{
  const TriangulatedGrid grid (8, 0.12, 4);
  LinearSystem system = systemOf (grid, Weighting::UNIFORM);
  for (int at = system.row_offsets[11]; at < system.row_offsets[12]; ++at)
    system.values[static_cast<std::size_t> (at)] = 0.0;
  for (const Solver solver : ALL_SOLVERS) {
    if (!isAvailable (solver))
      continue;
    SCOPED_TRACE (static_cast<int> (solver));
    EXPECT_EQ (solve (system, choice (solver)).outcome, Outcome::SINGULAR);
  }
}

TEST (Solvers, ReportASolutionThatIsNotFinite)
{
  const TriangulatedGrid grid (8, 0.12, 5);
  LinearSystem system = systemOf (grid, Weighting::UNIFORM);
  system.rhs_v[3] = std::numeric_limits<double>::quiet_NaN ();
  for (const Solver solver : ALL_SOLVERS) {
    if (!isAvailable (solver))
      continue;
    SCOPED_TRACE (static_cast<int> (solver));
    Options options = choice (solver);
    options.solver.max_iterations = 50;
    const Solution solution = solve (system, options);
    EXPECT_EQ (solution.outcome, Outcome::FAILED);
    EXPECT_TRUE (solution.uv.empty ());
  }
}

TEST (Solvers, ThatIterateGiveUpRatherThanBeWrong)
{
  const TriangulatedGrid grid (40, 0.12, 6);
  const LinearSystem system = systemOf (grid, Weighting::MEAN_VALUE);
  for (const Solver solver : {Solver::BICGSTAB_ILUT, Solver::GAUSS_SEIDEL}) {
    Options options = choice (solver);
    options.solver.max_iterations = 4;
    const Solution solution = solve (system, options);
    EXPECT_EQ (solution.outcome, Outcome::NOT_CONVERGED);
    EXPECT_TRUE (solution.uv.empty ());
    EXPECT_EQ (solution.iterations[0], 4U);
    EXPECT_GT (solution.relative_residual, options.solver.tolerance);
    EXPECT_NE (solution.message.find ("residual"), std::string::npos);
  }
}

TEST (Solvers, ThatIterateStopAtTheTolerance)
{
  const TriangulatedGrid grid (30, 0.12, 7);
  const LinearSystem system = systemOf (grid, Weighting::MEAN_VALUE);
  for (const Solver solver : {Solver::BICGSTAB_ILUT, Solver::GAUSS_SEIDEL}) {
    std::size_t before = 0;
    for (const double tolerance : {1e-3, 1e-7, 1e-11, 1e-15}) {
      Options options = choice (solver);
      options.solver.tolerance = tolerance;
      const Solution solution = solve (system, options);
      ASSERT_EQ (solution.outcome, Outcome::OK) << solution.message;
      const Residual residual = measureResidual (system, solution.uv);
      EXPECT_TRUE (residual.isWithin (tolerance, 0) && residual.isWithin (tolerance, 1));
      EXPECT_LE (solution.relative_residual, std::max (tolerance, 1e-13));
      EXPECT_EQ (solution.relative_residual,
                 std::max (residual.relative (0), residual.relative (1)));
      EXPECT_GT (solution.iterations[0], before) << tolerance;
      before = solution.iterations[0];
    }
  }
  // Gauss-Seidel stalls: that is what it is here for.
  Options options = choice (Solver::GAUSS_SEIDEL);
  options.solver.tolerance = 1e-11;
  const std::size_t sweeps = solve (system, options).iterations[0];
  options.solver.method = Solver::BICGSTAB_ILUT;
  EXPECT_GT (sweeps, 20 * solve (system, options).iterations[0]);
}

TEST (Solvers, KeepMoreOfTheFactorsIfAskedTo)
{
  const TriangulatedGrid grid (30, 0.12, 8);
  const LinearSystem system = systemOf (grid, Weighting::MEAN_VALUE);
  Options options = choice (Solver::BICGSTAB_ILUT);
  const Solution usual = solve (system, options);
  options.solver.ilut_fill = 3;
  const Solution sparse = solve (system, options);
  options.solver.ilut_fill = 60;
  options.solver.ilut_drop = 1e-6;
  const Solution dense = solve (system, options);
  EXPECT_LT (sparse.nnz_factors, usual.nnz_factors);
  EXPECT_LT (usual.nnz_factors, dense.nnz_factors);
  EXPECT_GT (sparse.iterations[0], usual.iterations[0]);
  EXPECT_GT (usual.iterations[0], dense.iterations[0]);
}

TEST (Solvers, DoNotDependOnTheThreads)
{
  const TriangulatedGrid grid (20, 0.12, 9);
  const LinearSystem system = systemOf (grid, Weighting::MEAN_VALUE);
  for (const Solver solver : ALL_SOLVERS) {
    if (!isAvailable (solver))
      continue;
    Options options = choice (solver);
    options.threads = 1;
    const Solution one = solve (system, options);
    options.threads = 2;
    EXPECT_EQ (one.uv, solve (system, options).uv) << static_cast<int> (solver);
    EXPECT_FALSE (one.uv.empty ());
  }
}

TEST (Solvers, LeaveZeroWhereTheRightHandSideIs)
{
  const TriangulatedGrid grid (10, 0.12, 10);
  LinearSystem system = systemOf (grid, Weighting::MEAN_VALUE);
  std::fill (system.rhs_v.begin (), system.rhs_v.end (), 0.0);
  for (const Solver solver : ALL_SOLVERS) {
    if (!isAvailable (solver))
      continue;
    const Solution solution = solve (system, choice (solver));
    ASSERT_EQ (solution.outcome, Outcome::OK) << static_cast<int> (solver) << solution.message;
    for (const Eigen::Vector2d& uv : solution.uv)
      EXPECT_EQ (uv.y (), 0.0);
  }
}

TEST (OrderingOfUnknowns, ArePermutations)
{
  const TriangulatedGrid grid (20, 0.12, 11);
  const LinearSystem system = systemOf (grid, Weighting::MEAN_VALUE);
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

TEST (OrderingOfUnknowns, ReverseCuthillMckeeNarrowsTheBand)
{
  const TriangulatedGrid grid (30, 0.12, 12);
  const LinearSystem narrow = systemOf (grid, Weighting::MEAN_VALUE); // row by row: 28 or 29
  const LinearSystem wide = permuteSystem (narrow, randomOrder (narrow.unknowns (), 13));
  EXPECT_GT (bandwidth (wide), 500);
  EXPECT_LT (bandwidth (permuteSystem (wide, reverseCuthillMckee (wide))), 60);
}

TEST (OrderingOfUnknowns, PermutingMovesRowsColumnsAndRightHandSides)
{
  const TriangulatedGrid grid (9, 0.12, 14);
  const LinearSystem system = systemOf (grid, Weighting::SHAPE_PRESERVING);
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
} // namespace floater
} // namespace pcl
