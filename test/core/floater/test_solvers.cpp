// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// All solvers in all orders, on systems whose solution is known.
#include "floater/solvers/solver.h"

#include "floater/grid_system.h"
#include "floater/solvers/floating_unknowns.h"
#include "floater/solvers/ordering.h"
#include "floater/solvers/residual.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace pcl::floater {
namespace {
using Outcome = Solution::Outcome;

constexpr Solver ALL_SOLVERS[] = {Solver::UMFPACK,       Solver::UMFPACK_UNSYMMETRIC,
                                  Solver::SUPERLU,       Solver::EIGEN_SPARSE_LU,
                                  Solver::BICGSTAB_ILUT, Solver::GAUSS_SEIDEL};
constexpr Ordering ALL_ORDERINGS[] = {Ordering::AUTOMATIC, Ordering::AMD,
                                      Ordering::METIS,     Ordering::COLAMD,
                                      Ordering::NATURAL,   Ordering::REVERSE_CUTHILL_MCKEE};

bool
isIterative (Solver solver)
{
  return solver == Solver::BICGSTAB_ILUT || solver == Solver::GAUSS_SEIDEL;
}

SolverOptions
choice (Solver solver, Ordering ordering = Ordering::AUTOMATIC)
{
  SolverOptions options;
  options.method = solver;
  options.ordering = ordering;
  options.max_iterations = 100000; // enough for Gauss-Seidel on what is solved here
  return options;
}

Solution
solveOnAllCores (const LinearSystem& system, const SolverOptions& options)
{
  return solve (system, options, nullptr, 0);
}

// Cuts the last unknowns off from the others and from the loop, so that they float.
void
cutOff (std::size_t floating, LinearSystem& system)
{
  const std::size_t first = system.unknowns () - floating;
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

// With weights that reproduce linear functions, the only solution is the flat sheet in its place.
TEST (Solvers, ReproduceLinearFunctionsInEveryOrder)
{
  const TriangulatedGrid grid (14, 0.12, 1);
  for (const Weighting weighting : {Weighting::MEAN_VALUE, Weighting::SHAPE_PRESERVING}) {
    const LinearSystem system = gridSystem (grid, weighting);
    for (const Solver solver : ALL_SOLVERS)
      for (const Ordering ordering : ALL_ORDERINGS) {
        if (checkSolver (solver, ordering))
          continue;
        SCOPED_TRACE (testing::Message () << "solver " << static_cast<int> (solver) << " ordering "
                                          << static_cast<int> (ordering));
        const Solution solution = solveOnAllCores (system, choice (solver, ordering));
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

TEST (Solvers, UseTheOrderThatIsAskedFor)
{
  const TriangulatedGrid grid (30, 0.12, 2);
  const LinearSystem grid_system = gridSystem (grid, Weighting::MEAN_VALUE);
  const LinearSystem system = permuteSystem (grid_system, randomOrder (grid_system.unknowns (), 5));
  for (const Solver solver : ALL_SOLVERS) {
    if (!isAvailable (solver) || isIterative (solver))
      continue;
    SCOPED_TRACE (static_cast<int> (solver));
    const auto fill = [&] (Ordering ordering) {
      const Solution solution = solveOnAllCores (system, choice (solver, ordering));
      EXPECT_EQ (solution.outcome, Outcome::OK) << solution.message;
      return solution.nnz_factors;
    };
    const std::size_t natural = fill (Ordering::NATURAL);
    const std::size_t band = fill (Ordering::REVERSE_CUTHILL_MCKEE);
    EXPECT_GT (natural, 2 * band);
    EXPECT_GT (natural, 2 * fill (Ordering::AUTOMATIC));
    if (solver == Solver::UMFPACK_UNSYMMETRIC)
      continue; // it chooses an order of the rows by itself
    EXPECT_GT (band, fill (Ordering::AMD));
    EXPECT_GT (band, fill (Ordering::METIS));
  }
}

TEST (Solvers, WithDiagonalPivotsRefuseColamd)
{
  LinearSystem system;
  system.row_offsets = {0};
  for (const Solver solver : {Solver::UMFPACK, Solver::BICGSTAB_ILUT, Solver::GAUSS_SEIDEL}) {
    const Problem problem = checkSolver (solver, Ordering::COLAMD);
    EXPECT_EQ (problem.status, RunStatus::INVALID_OPTION);
    EXPECT_NE (problem.message.find ("COLAMD"), std::string::npos);
    EXPECT_EQ (solveOnAllCores (system, choice (solver, Ordering::COLAMD)).outcome,
               Outcome::FAILED);
  }
}

// 250,000 rows of up to 20,000 entries each are more than Eigen counts.
TEST (Solvers, RefuseFactorsThatTheyCannotCount)
{
  constexpr int UNKNOWNS = 250'000;
  LinearSystem system;
  system.point_of_unknown.resize (UNKNOWNS);
  system.rhs_u = system.rhs_v = system.values = std::vector<double> (UNKNOWNS, 1.0);
  for (int i = 0; i <= UNKNOWNS; ++i)
    system.row_offsets.push_back (i);
  system.columns.assign (system.row_offsets.begin (), system.row_offsets.end () - 1);
  SolverOptions options = choice (Solver::BICGSTAB_ILUT);
  EXPECT_EQ (solveOnAllCores (system, options).outcome, Outcome::OK);
  options.ilut_fill = 10'000;
  EXPECT_THROW (solveOnAllCores (system, options), IndexLimitReached);
}

TEST (Solvers, TellIfTheyAreNotBuilt)
{
  for (const Solver solver : ALL_SOLVERS) {
    LinearSystem system;
    system.row_offsets = {0};
    const Problem problem = checkSolver (solver, Ordering::AUTOMATIC);
    const Solution solution = solveOnAllCores (system, choice (solver));
    EXPECT_EQ (problem.status,
               isAvailable (solver) ? RunStatus::SUCCESS : RunStatus::SOLVER_UNAVAILABLE);
    EXPECT_EQ (problem.message.empty (), isAvailable (solver));
    EXPECT_EQ (solution.outcome, isAvailable (solver) ? Outcome::OK : Outcome::UNAVAILABLE);
    EXPECT_EQ (solution.message, problem.message);
    EXPECT_TRUE (solver == Solver::SUPERLU || isAvailable (solver));
  }
}

TEST (Solvers, RefuseFloatingUnknowns)
{
  const TriangulatedGrid grid (16, 0.12, 3);
  for (const std::size_t floating : {20, 50, 140}) {
    LinearSystem system = gridSystem (grid, Weighting::MEAN_VALUE);
    cutOff (floating, system);
    EXPECT_EQ (countFloatingUnknowns (system), floating);
    for (const Solver solver : ALL_SOLVERS)
      for (const Ordering ordering : {Ordering::AUTOMATIC, Ordering::REVERSE_CUTHILL_MCKEE}) {
        if (!isAvailable (solver))
          continue;
        SCOPED_TRACE (testing::Message ()
                      << "solver " << static_cast<int> (solver) << " ordering "
                      << static_cast<int> (ordering) << " floating " << floating);
        const Solution solution = solveOnAllCores (system, choice (solver, ordering));
        EXPECT_EQ (solution.outcome, Outcome::SINGULAR);
        EXPECT_FALSE (solution.message.empty ());
        EXPECT_TRUE (solution.uv.empty ());
      }
  }
}

TEST (Solvers, RefuseARowWithoutWeights)
{
  const TriangulatedGrid grid (8, 0.12, 4);
  LinearSystem system = gridSystem (grid, Weighting::UNIFORM);
  for (int at = system.row_offsets[11]; at < system.row_offsets[12]; ++at)
    system.values[static_cast<std::size_t> (at)] = 0.0;
  for (const Solver solver : ALL_SOLVERS) {
    if (!isAvailable (solver))
      continue;
    SCOPED_TRACE (static_cast<int> (solver));
    EXPECT_EQ (solveOnAllCores (system, choice (solver)).outcome, Outcome::SINGULAR);
  }
}

TEST (Solvers, ReportASolutionThatIsNotFinite)
{
  const TriangulatedGrid grid (8, 0.12, 5);
  LinearSystem system = gridSystem (grid, Weighting::UNIFORM);
  system.rhs_v[3] = std::numeric_limits<double>::quiet_NaN ();
  for (const Solver solver : ALL_SOLVERS) {
    if (!isAvailable (solver))
      continue;
    SCOPED_TRACE (static_cast<int> (solver));
    SolverOptions options = choice (solver);
    options.max_iterations = 50;
    const Solution solution = solveOnAllCores (system, options);
    EXPECT_EQ (solution.outcome, Outcome::FAILED);
    EXPECT_TRUE (solution.uv.empty ());
  }
}

TEST (Solvers, ThatIterateTellIfTheyDoNotConverge)
{
  const TriangulatedGrid grid (40, 0.12, 6);
  const LinearSystem system = gridSystem (grid, Weighting::MEAN_VALUE);
  for (const Solver solver : {Solver::BICGSTAB_ILUT, Solver::GAUSS_SEIDEL}) {
    SolverOptions options = choice (solver);
    options.max_iterations = 4;
    const Solution solution = solveOnAllCores (system, options);
    EXPECT_EQ (solution.outcome, Outcome::NOT_CONVERGED);
    EXPECT_TRUE (solution.uv.empty ());
    EXPECT_EQ (solution.iterations[0], 4U);
    EXPECT_GT (solution.relative_residual, options.tolerance);
    EXPECT_NE (solution.message.find ("residual"), std::string::npos);
  }
}

TEST (Solvers, ThatIterateStopAtTheTolerance)
{
  const TriangulatedGrid grid (30, 0.12, 7);
  const LinearSystem system = gridSystem (grid, Weighting::MEAN_VALUE);
  for (const Solver solver : {Solver::BICGSTAB_ILUT, Solver::GAUSS_SEIDEL}) {
    std::size_t before = 0;
    for (const double tolerance : {1e-3, 1e-7, 1e-11, 1e-15}) {
      SolverOptions options = choice (solver);
      options.tolerance = tolerance;
      const Solution solution = solveOnAllCores (system, options);
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
  // Gauss-Seidel is slow: it is here only for comparison.
  SolverOptions options = choice (Solver::GAUSS_SEIDEL);
  options.tolerance = 1e-11;
  const std::size_t sweeps = solveOnAllCores (system, options).iterations[0];
  options.method = Solver::BICGSTAB_ILUT;
  EXPECT_GT (sweeps, 20 * solveOnAllCores (system, options).iterations[0]);
}

TEST (Solvers, KeepAsMuchOfTheFactorsAsIsAskedFor)
{
  const TriangulatedGrid grid (30, 0.12, 8);
  const LinearSystem system = gridSystem (grid, Weighting::MEAN_VALUE);
  SolverOptions options = choice (Solver::BICGSTAB_ILUT);
  const Solution usual = solveOnAllCores (system, options);
  options.ilut_fill = 3;
  const Solution sparse = solveOnAllCores (system, options);
  options.ilut_fill = 60;
  options.ilut_drop = 1e-6;
  const Solution dense = solveOnAllCores (system, options);
  EXPECT_LT (sparse.nnz_factors, usual.nnz_factors);
  EXPECT_LT (usual.nnz_factors, dense.nnz_factors);
  EXPECT_GT (sparse.iterations[0], usual.iterations[0]);
  EXPECT_GT (usual.iterations[0], dense.iterations[0]);
}

TEST (Solvers, DoNotDependOnTheThreads)
{
  const TriangulatedGrid grid (20, 0.12, 9);
  const LinearSystem system = gridSystem (grid, Weighting::MEAN_VALUE);
  for (const Solver solver : ALL_SOLVERS) {
    if (!isAvailable (solver))
      continue;
    SolverOptions options = choice (solver);
    const Solution one = solve (system, options, nullptr, 1);
    EXPECT_EQ (one.uv, solve (system, options, nullptr, 2).uv) << static_cast<int> (solver);
    EXPECT_FALSE (one.uv.empty ());
  }
}

TEST (Solvers, ReturnZeroForARightHandSideOfZero)
{
  const TriangulatedGrid grid (10, 0.12, 10);
  LinearSystem system = gridSystem (grid, Weighting::MEAN_VALUE);
  std::fill (system.rhs_v.begin (), system.rhs_v.end (), 0.0);
  for (const Solver solver : ALL_SOLVERS) {
    if (!isAvailable (solver))
      continue;
    const Solution solution = solveOnAllCores (system, choice (solver));
    ASSERT_EQ (solution.outcome, Outcome::OK) << static_cast<int> (solver) << solution.message;
    for (const Eigen::Vector2d& uv : solution.uv)
      EXPECT_EQ (uv.y (), 0.0);
  }
}

} // namespace
} // namespace pcl::floater
