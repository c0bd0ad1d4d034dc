// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// All solvers in all orders, on systems whose solution is known.
#include "core/single_blas_thread.h"
#include "floater/grid_system.h"
#include "floater/solvers/solver_parts.h"

#include <Eigen/LU>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <thread>

namespace pcl::floater {
namespace {
using Outcome = Solution::Outcome;

constexpr Ordering ALL_ORDERINGS[] = {Ordering::AUTOMATIC, Ordering::AMD, Ordering::METIS,
                                      Ordering::NATURAL, Ordering::REVERSE_CUTHILL_MCKEE};

bool
isIterative (Solver solver)
{
  return solver == Solver::BICGSTAB_ILUT || solver == Solver::GAUSS_SEIDEL;
}

// Those that this build has.
std::vector<Solver>
allSolvers ()
{
  std::vector<Solver> solvers{Solver::UMFPACK, Solver::BICGSTAB_ILUT, Solver::GAUSS_SEIDEL};
  if (!checkSolver (Solver::SUPERLU, Ordering::AUTOMATIC))
    solvers.push_back (Solver::SUPERLU);
  return solvers;
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

// Adds a ring of unknowns that depend on each other only.
void
addFloating (int count, RandomStream& random, LinearSystem& system)
{
  const auto first = static_cast<int> (system.unknowns ());
  for (int i = 0; i < count; ++i) {
    std::vector<std::pair<int, double>> row{{first + i, 0.0}};
    for (const int step : {1, 2, count - 1}) {
      row.emplace_back (first + (i + step) % count, -0.1 - random.uniform ());
      row.front ().second -= row.back ().second;
    }
    system.addRow (row);
  }
  system.rhs.conservativeResizeLike (Eigen::MatrixX2d::Zero (first + count, 2));
}

// Random entries and a dominant diagonal. The pattern is not symmetric.
LinearSystem
randomSystem (int n, RandomStream& random)
{
  LinearSystem system;
  for (int i = 0; i < n; ++i) {
    std::map<int, double> entries;
    double sum = 0.1;
    for (int entry = 0; entry < 5; ++entry)
      sum += std::abs (entries[static_cast<int> (random.below (static_cast<std::size_t> (n)))] =
                           2.0 * random.uniform () - 1.0);
    entries[i] = 2.0 * sum;
    std::vector<std::pair<int, double>> row (entries.begin (), entries.end ());
    system.addRow (row);
  }
  system.rhs = Eigen::MatrixX2d::NullaryExpr (n, 2, [&] { return random.uniform () - 0.5; });
  return system;
}

void
expectFailure (const Solution& solution, Outcome outcome)
{
  EXPECT_EQ (solution.outcome, outcome);
  EXPECT_FALSE (solution.message.empty ());
  EXPECT_EQ (solution.uv.rows (), 0);
}

// With weights that reproduce linear functions, the only solution is the flat sheet in its place.
TEST (Solvers, ReproduceLinearFunctionsInEveryOrder)
{
  const TriangulatedGrid grid (14, 0.12, 1);
  for (const Weighting weighting : {Weighting::MEAN_VALUE, Weighting::SHAPE_PRESERVING}) {
    const LinearSystem system = gridSystem (grid, weighting);
    for (const Solver solver : allSolvers ())
      for (const Ordering ordering : ALL_ORDERINGS) {
        SCOPED_TRACE (testing::Message () << "solver " << static_cast<int> (solver) << " ordering "
                                          << static_cast<int> (ordering));
        const Solution solution = solve (system, choice (solver, ordering), 1);
        ASSERT_EQ (solution.outcome, Outcome::OK) << solution.message;
        for (Eigen::Index i = 0; i < solution.uv.rows (); ++i) {
          const Index point = system.point_of_unknown[static_cast<std::size_t> (i)];
          const Eigen::Vector2d place = grid.positions[point].head<2> ();
          ASSERT_LT ((solution.uv.row (i).transpose () - place).norm (), 1e-12) << i;
        }
        const Eigen::MatrixX2d rest = system.rhs - denseMatrix (system) * solution.uv;
        EXPECT_NEAR (solution.residual, rest.cwiseAbs ().maxCoeff (), 2e-15);
        EXPECT_LT (solution.residual, 1e-14);
        EXPECT_GT (solution.relative_residual, 0.0);
        EXPECT_LT (solution.relative_residual, 1e-14);
        EXPECT_EQ (solution.iterations[0] > 0, isIterative (solver));
        EXPECT_EQ (solution.iterations[1] > 0, isIterative (solver));
        if (!isIterative (solver)) {
          EXPECT_GE (solution.nnz_factors, system.nonzeros ());
          EXPECT_GE (solution.peak_bytes, 8 * solution.nnz_factors);
          EXPECT_LT (solution.peak_bytes, 200 * solution.nnz_factors);
          EXPECT_GT (solution.reciprocal_condition, 1e-3);
          EXPECT_LE (solution.reciprocal_condition, 1.0);
        }
        EXPECT_EQ (solve (system, choice (solver, ordering), 2).uv, solution.uv);
      }
  }
}

TEST (Solvers, AgreeWithADenseFactorization)
{
  RandomStream random (3);
  for (const int n : {1, 2, 10, 300}) {
    LinearSystem system = randomSystem (n, random);
    if (n == 10)
      system.rhs.col (0).setZero ();
    const Eigen::MatrixX2d expected = denseMatrix (system).partialPivLu ().solve (system.rhs);
    for (const Solver solver : allSolvers ())
      for (const Ordering ordering : ALL_ORDERINGS) {
        const Solution solution = solve (system, choice (solver, ordering), 1);
        ASSERT_EQ (solution.outcome, Outcome::OK) << solution.message;
        EXPECT_LT ((solution.uv - expected).cwiseAbs ().maxCoeff (), 1e-13)
            << n << " unknowns, solver " << static_cast<int> (solver);
      }
  }
}

TEST (Solvers, UseTheOrderThatIsAskedFor)
{
  const TriangulatedGrid grid (30, 0.12, 2);
  const LinearSystem grid_system = gridSystem (grid);
  const LinearSystem system = permuteSystem (grid_system, randomOrder (grid_system.unknowns (), 5));
  for (const Solver solver : allSolvers ()) {
    if (isIterative (solver))
      continue;
    SCOPED_TRACE (static_cast<int> (solver));
    const auto fill = [&] (Ordering ordering) {
      return solve (system, choice (solver, ordering), 1).nnz_factors;
    };
    const std::size_t natural = fill (Ordering::NATURAL), amd = fill (Ordering::AMD);
    const std::size_t metis = fill (Ordering::METIS);
    const std::size_t band = fill (Ordering::REVERSE_CUTHILL_MCKEE);
    EXPECT_GT (natural, 2 * band);
    EXPECT_GT (natural, 2 * fill (Ordering::AUTOMATIC));
    EXPECT_GT (band, amd);
    EXPECT_GT (band, metis);
    EXPECT_NE (amd, metis) << "the same ordering twice";
  }
}

TEST (Solvers, TakeMetisForLargeSystems)
{
  const TriangulatedGrid grid (320, 0.1, 7105);
  const LinearSystem system = gridSystem (grid);
  const Solution automatic = solve (system, choice (Solver::UMFPACK), 2);
  const Solution metis = solve (system, choice (Solver::UMFPACK, Ordering::METIS), 1);
  ASSERT_EQ (metis.outcome, Outcome::OK);
  EXPECT_EQ (automatic.uv, metis.uv);
  EXPECT_NE (automatic.nnz_factors,
             solve (system, choice (Solver::UMFPACK, Ordering::AMD), 1).nnz_factors);
}

// A matrix that is triangular has no fill.
TEST (Solvers, CountTheDiagonalOnce)
{
  LinearSystem system;
  system.row_offsets = {0, 1, 3, 5};
  system.columns = {0, 0, 1, 1, 2};
  system.values = {1.0, -0.5, 2.0, -1.0, 4.0};
  system.rhs.setOnes (3, 2);
  const Solution solution = solve (system, choice (Solver::UMFPACK), 1);
  EXPECT_EQ (solution.nnz_factors, 5U);
  EXPECT_DOUBLE_EQ (solution.reciprocal_condition, 0.25);
}

// Above a million unknowns, indices have 64 bits. The matrix is triangular, which is quick: each
// unknown is the mean of the one before it and of 1 or 0.
TEST (Solvers, WithLongIndices)
{
  constexpr int UNKNOWNS = 1000001, LENGTH = 4;
  LinearSystem system;
  system.rhs.resize (UNKNOWNS, 2);
  for (int i = 0; i < UNKNOWNS; ++i) {
    std::vector<std::pair<int, double>> row{{i, 1.0}};
    if (i % LENGTH != 0)
      row.emplace_back (i - 1, -0.5);
    system.addRow (row);
    system.rhs.row (i) << 0.5, i % LENGTH == 0 ? 1.0 : 0.0;
  }
  const Solution solution = solve (system, choice (Solver::UMFPACK, Ordering::AMD), 2);
  ASSERT_EQ (solution.outcome, Outcome::OK) << solution.message;
  EXPECT_EQ (solution.residual, 0.0);
  for (int i = 0; i < UNKNOWNS; ++i) {
    const double power = std::ldexp (1.0, -(i % LENGTH));
    ASSERT_EQ (solution.uv.row (i), Eigen::RowVector2d (1.0 - 0.5 * power, power));
  }
}

TEST (Solvers, TellIfTheyAreNotThere)
{
  const LinearSystem empty;
  for (const Solver solver : {Solver::UMFPACK_UNSYMMETRIC, Solver::EIGEN_SPARSE_LU}) {
    const Problem problem = checkSolver (solver, Ordering::AUTOMATIC);
    EXPECT_EQ (problem.status, RunStatus::SOLVER_UNAVAILABLE);
    EXPECT_NE (problem.message.find ("choose another solver"), std::string::npos);
    expectFailure (solve (empty, choice (solver), 1), Outcome::UNAVAILABLE);
  }
  for (const Solver solver : allSolvers ()) {
    EXPECT_FALSE (checkSolver (solver, Ordering::AUTOMATIC));
    EXPECT_EQ (solve (empty, choice (solver), 1).outcome, Outcome::OK);
    EXPECT_EQ (checkSolver (solver, Ordering::COLAMD).status, RunStatus::INVALID_OPTION);
    expectFailure (solve (empty, choice (solver, Ordering::COLAMD), 1), Outcome::FAILED);
  }
}

TEST (Solvers, RefuseFloatingUnknowns)
{
  const TriangulatedGrid grid (16, 0.12, 3);
  RandomStream random (8);
  for (const int floating : {4, 50, 5000}) {
    LinearSystem system = gridSystem (grid);
    addFloating (floating, random, system);
    EXPECT_EQ (countFloatingUnknowns (system), static_cast<std::size_t> (floating));
    for (const Solver solver : allSolvers ())
      for (const Ordering ordering : {Ordering::AUTOMATIC, Ordering::REVERSE_CUTHILL_MCKEE}) {
        SCOPED_TRACE (testing::Message () << "solver " << static_cast<int> (solver) << " ordering "
                                          << static_cast<int> (ordering));
        expectFailure (solve (system, choice (solver, ordering), 1), Outcome::SINGULAR);
      }
  }
}

TEST (Solvers, RefuseWhatTheyCannotSolve)
{
  const TriangulatedGrid grid (8, 0.12, 4);
  LinearSystem without_weights = gridSystem (grid), infinite = without_weights;
  for (int at = infinite.row_offsets[11]; at < infinite.row_offsets[12]; ++at)
    without_weights.values[static_cast<std::size_t> (at)] = 0.0;
  infinite.rhs (3, 1) = std::numeric_limits<double>::quiet_NaN ();
  for (const Solver solver : allSolvers ()) {
    SCOPED_TRACE (static_cast<int> (solver));
    SolverOptions options = choice (solver);
    options.max_iterations = 50;
    expectFailure (solve (without_weights, options, 1), Outcome::SINGULAR);
    expectFailure (solve (infinite, options, 1), Outcome::FAILED);
  }
  LinearSystem unsorted = gridSystem (grid);
  std::swap (unsorted.columns[0], unsorted.columns[1]);
  expectFailure (solve (unsorted, choice (Solver::UMFPACK), 1), Outcome::FAILED);
}

// 250,000 rows of up to 20,000 entries each are more than Eigen counts.
TEST (Solvers, RefuseFactorsThatTheyCannotCount)
{
  constexpr int UNKNOWNS = 250'000;
  LinearSystem system;
  system.rhs.setOnes (UNKNOWNS, 2);
  system.values.assign (UNKNOWNS, 1.0);
  for (int i = 0; i < UNKNOWNS; ++i) {
    system.columns.push_back (i);
    system.row_offsets.push_back (i + 1);
  }
  SolverOptions options = choice (Solver::BICGSTAB_ILUT);
  EXPECT_EQ (solve (system, options, 1).outcome, Outcome::OK);
  options.ilut_fill = 10'000;
  EXPECT_THROW (solve (system, options, 1), IndexLimitReached);
}

TEST (Solvers, ThatIterateStopAtTheToleranceOrTellThatTheyDoNot)
{
  const TriangulatedGrid grid (30, 0.12, 7);
  const LinearSystem system = gridSystem (grid);
  std::array<std::size_t, 2> iterations{}; // at the last tolerance
  for (const Solver solver : {Solver::BICGSTAB_ILUT, Solver::GAUSS_SEIDEL}) {
    std::size_t& before = iterations[solver == Solver::GAUSS_SEIDEL ? 1 : 0];
    for (const double tolerance : {1e-3, 1e-7, 1e-11, 1e-15}) {
      SolverOptions options = choice (solver);
      options.tolerance = tolerance;
      const Solution solution = solve (system, options, 1);
      ASSERT_EQ (solution.outcome, Outcome::OK) << solution.message;
      EXPECT_LE (solution.relative_residual, std::max (tolerance, 1e-13));
      EXPECT_GT (solution.iterations[0], before) << tolerance;
      before = solution.iterations[0];
    }
    SolverOptions options = choice (solver);
    options.max_iterations = 4;
    const Solution solution = solve (system, options, 1);
    expectFailure (solution, Outcome::NOT_CONVERGED);
    EXPECT_EQ (solution.iterations[0], 4U);
    EXPECT_GT (solution.relative_residual, options.tolerance);
    EXPECT_NE (solution.message.find ("residual"), std::string::npos);
  }
  EXPECT_LT (iterations[0], 25U);
  EXPECT_GT (iterations[1], 20 * iterations[0]); // Gauss-Seidel is here only for comparison
}

TEST (Solvers, KeepAsMuchOfTheFactorsAsIsAskedFor)
{
  const TriangulatedGrid grid (30, 0.12, 8);
  const LinearSystem system = gridSystem (grid);
  const auto solved = [&] (int fill, double drop) {
    SolverOptions options = choice (Solver::BICGSTAB_ILUT);
    options.ilut_fill = fill;
    options.ilut_drop = drop;
    return solve (system, options, 1);
  };
  const Solution sparse = solved (3, 1e-2), usual = solved (15, 1e-2), dense = solved (15, 1e-6);
  const Solution full = solved (60, 1e-6);
  EXPECT_LT (sparse.nnz_factors, usual.nnz_factors);
  EXPECT_LT (usual.nnz_factors, dense.nnz_factors);
  EXPECT_LT (dense.nnz_factors, full.nnz_factors);
  EXPECT_GT (sparse.iterations[0], usual.iterations[0]);
  EXPECT_GT (usual.iterations[0], full.iterations[0]);
}

// The threads of the BLAS that the test runs with.
class BlasThreads : public testing::Test
{
protected:
  int (*get_) () = reinterpret_cast<int (*) ()> (dlsym (RTLD_DEFAULT, "openblas_get_num_threads"));
  void (*set_) (int) = reinterpret_cast<void (*) (int)> (dlsym (RTLD_DEFAULT,
                                                                "openblas_set_num_threads"));
  int before_ = 1;

  void SetUp () override
  {
    if (get_ == nullptr || set_ == nullptr)
      GTEST_SKIP () << "the BLAS is not OpenBLAS";
    before_ = get_ ();
    set_ (2);
    ASSERT_EQ (get_ (), 2);
  }
  void TearDown () override
  {
    if (set_ != nullptr)
      set_ (before_);
  }
};

TEST_F (BlasThreads, AreOneWhileAnyScopeLasts)
{
  {
    const SingleBlasThread outer;
    {
      const SingleBlasThread inner;
      EXPECT_EQ (get_ (), 1);
    }
    EXPECT_EQ (get_ (), 1);
  }
  EXPECT_EQ (get_ (), 2);
}

// The fronts are so large that OpenBLAS would use both threads, and the last digits would differ.
TEST_F (BlasThreads, DoNotChangeASolutionAndAreRestored)
{
  RandomStream random (12);
  const LinearSystem system = randomSystem (1500, random);
  std::array<Eigen::MatrixX2d, 2> by_two;
  std::vector<std::thread> solvers;
  for (Eigen::MatrixX2d& uv : by_two)
    solvers.emplace_back (
        [&] { uv = solve (system, choice (Solver::UMFPACK, Ordering::AMD), 1).uv; });
  for (std::thread& solver : solvers)
    solver.join ();
  EXPECT_EQ (get_ (), 2);
  set_ (1);
  const Solution one = solve (system, choice (Solver::UMFPACK, Ordering::AMD), 1);
  ASSERT_EQ (one.outcome, Outcome::OK) << one.message;
  EXPECT_EQ (one.uv, by_two[0]);
  EXPECT_EQ (one.uv, by_two[1]);
}

} // namespace
} // namespace pcl::floater
