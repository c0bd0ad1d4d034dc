// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/umfpack_solver.h"

#include "floater/domain.h"
#include "floater/grid_system.h"
#include "floater/solvers/single_blas_thread.h"

#include <Eigen/SparseLU>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

namespace pcl::floater {
namespace {
using Outcome = Solution::Outcome;
using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

Matrix
matrixOf (const LinearSystem& system)
{
  const auto n = static_cast<Eigen::Index> (system.unknowns ());
  return Eigen::Map<const Matrix> (n, n, static_cast<Eigen::Index> (system.nonzeros ()),
                                   system.row_offsets.data (), system.columns.data (),
                                   system.values.data ());
}

Eigen::MatrixX2d
rightHandSidesOf (const LinearSystem& system)
{
  const auto n = static_cast<Eigen::Index> (system.unknowns ());
  Eigen::MatrixX2d rhs (n, 2);
  rhs.col (0) = Eigen::Map<const Eigen::VectorXd> (system.rhs_u.data (), n);
  rhs.col (1) = Eigen::Map<const Eigen::VectorXd> (system.rhs_v.data (), n);
  return rhs;
}

Eigen::MatrixX2d
unknownsOf (const Solution& solution)
{
  Eigen::MatrixX2d unknowns (solution.uv.size (), 2);
  for (std::size_t i = 0; i < solution.uv.size (); ++i)
    unknowns.row (static_cast<Eigen::Index> (i)) = solution.uv[i].transpose ();
  return unknowns;
}

LinearSystem
systemOf (const Matrix& matrix, RandomStream& random)
{
  LinearSystem system;
  const auto n = static_cast<std::size_t> (matrix.rows ());
  system.point_of_unknown.resize (n);
  system.row_offsets.assign (matrix.outerIndexPtr (), matrix.outerIndexPtr () + n + 1);
  system.columns.assign (matrix.innerIndexPtr (), matrix.innerIndexPtr () + matrix.nonZeros ());
  system.values.assign (matrix.valuePtr (), matrix.valuePtr () + matrix.nonZeros ());
  for (std::size_t i = 0; i < n; ++i) {
    system.rhs_u.push_back (random.uniform () - 0.5);
    system.rhs_v.push_back (random.uniform () - 0.5);
  }
  return system;
}

// Random entries and a dominant diagonal. The pattern is not symmetric.
LinearSystem
randomSystem (int n, RandomStream& random)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    double sum = 0.1;
    for (int entry = 0; entry < 5; ++entry) {
      const double value = 2.0 * random.uniform () - 1.0;
      entries.emplace_back (i, static_cast<int> (random.below (static_cast<std::size_t> (n))),
                            value);
      sum += std::abs (value);
    }
    entries.emplace_back (i, i, 2.0 * sum);
  }
  Matrix matrix (n, n);
  matrix.setFromTriplets (entries.begin (), entries.end ());
  return systemOf (matrix, random);
}

// Two unknowns that depend on the loop, and a ring of floating unknowns.
LinearSystem
systemWithFloating (int floating, RandomStream& random)
{
  std::vector<Eigen::Triplet<double>> entries{
      {0, 0, 1.0}, {0, 1, -0.5}, {1, 0, -0.25}, {1, 1, 1.0}};
  for (int i = 0; i < floating; ++i) {
    double sum = 0.0;
    for (const int step : {1, 2, floating - 1}) {
      const double weight = 0.1 + random.uniform ();
      entries.emplace_back (2 + i, 2 + (i + step) % floating, -weight);
      sum += weight;
    }
    entries.emplace_back (2 + i, 2 + i, sum);
  }
  Matrix matrix (2 + floating, 2 + floating);
  matrix.setFromTriplets (entries.begin (), entries.end ());
  return systemOf (matrix, random);
}

void
expectFailure (const Solution& solution, Outcome outcome)
{
  EXPECT_EQ (solution.outcome, outcome);
  EXPECT_FALSE (solution.message.empty ());
  EXPECT_TRUE (solution.uv.empty ());
}

TEST (UmfpackSolver, PutsAFlatSheetInItsPlace)
{
  const TriangulatedGrid grid (40, 0.12, 1);
  for (const Weighting weighting : {Weighting::MEAN_VALUE, Weighting::SHAPE_PRESERVING})
    for (const Ordering ordering : {Ordering::AUTOMATIC, Ordering::AMD, Ordering::METIS}) {
      const LinearSystem system = gridSystem (grid, weighting, grid.loopInPlace ());
      const Solution solution = solveWithUmfpack (system, ordering, 1);
      ASSERT_EQ (solution.outcome, Outcome::OK) << solution.message;
      for (std::size_t i = 0; i < system.unknowns (); ++i) {
        const Eigen::Vector3d& position = grid.positions[system.point_of_unknown[i]];
        ASSERT_LT ((solution.uv[i] - position.head<2> ()).norm (), 1e-12);
      }
    }
}

TEST (UmfpackSolver, StaysInsideTheLoop)
{
  const TriangulatedGrid grid (25, 0.12, 2);
  for (const Domain domain : {Domain::CIRCLE, Domain::SQUARE, Domain::POLYGON})
    for (const Weighting weighting : {Weighting::UNIFORM, Weighting::INVERSE_DISTANCE,
                                      Weighting::SHAPE_PRESERVING, Weighting::MEAN_VALUE}) {
      const std::vector<Eigen::Vector2d> loop_uv = layLoop (grid.positions, grid.loop, {domain, 5});
      const Solution solution =
          solveWithUmfpack (gridSystem (grid, weighting, loop_uv), Ordering::AUTOMATIC, 1);
      ASSERT_EQ (solution.outcome, Outcome::OK) << solution.message;
      for (const Eigen::Vector2d& uv : solution.uv)
        for (std::size_t i = 0; i < loop_uv.size (); ++i) {
          const Eigen::Vector2d edge = loop_uv[(i + 1) % loop_uv.size ()] - loop_uv[i];
          const Eigen::Vector2d to = uv - loop_uv[i];
          ASSERT_GT (edge.x () * to.y () - edge.y () * to.x (), 0.0);
        }
    }
}

TEST (UmfpackSolver, AgreesWithSparseLU)
{
  RandomStream random (3);
  for (const int n : {1, 2, 10, 300}) {
    const LinearSystem system = randomSystem (n, random);
    Eigen::SparseMatrix<double> by_columns = matrixOf (system);
    Eigen::SparseLU<Eigen::SparseMatrix<double>> lu (by_columns);
    const Eigen::MatrixX2d expected = lu.solve (rightHandSidesOf (system));
    for (const Ordering ordering : {Ordering::AMD, Ordering::METIS}) {
      const Solution solution = solveWithUmfpack (system, ordering, 1);
      ASSERT_EQ (solution.outcome, Outcome::OK) << solution.message;
      EXPECT_LT ((unknownsOf (solution) - expected).cwiseAbs ().maxCoeff (), 1e-13) << n;
    }
  }
}

TEST (UmfpackSolver, TellsWhatTheFactorizationCost)
{
  const TriangulatedGrid grid (50, 0.12, 4);
  const LinearSystem system = gridSystem (grid);
  const Solution amd = solveWithUmfpack (system, Ordering::AMD, 1);
  const Solution metis = solveWithUmfpack (system, Ordering::METIS, 1);
  ASSERT_EQ (amd.outcome, Outcome::OK) << amd.message;
  ASSERT_EQ (metis.outcome, Outcome::OK) << metis.message;
  EXPECT_LT ((unknownsOf (amd) - unknownsOf (metis)).cwiseAbs ().maxCoeff (), 1e-12);
  EXPECT_NE (amd.nnz_factors, metis.nnz_factors) << "the same ordering twice";
  for (const Solution& solution : {amd, metis}) {
    const Eigen::MatrixX2d rest =
        rightHandSidesOf (system) - matrixOf (system) * unknownsOf (solution);
    EXPECT_LT (solution.residual, 1e-14);
    EXPECT_GT (solution.residual, 0.0);
    EXPECT_NEAR (solution.residual, rest.cwiseAbs ().maxCoeff (), 1e-15);
    EXPECT_GE (solution.nnz_factors, system.nonzeros ());
    EXPECT_LT (solution.nnz_factors, 20 * system.nonzeros ());
    EXPECT_GE (solution.peak_bytes, 8 * solution.nnz_factors);
    EXPECT_LT (solution.peak_bytes, 200 * solution.nnz_factors);
    EXPECT_GT (solution.reciprocal_condition, 1e-3);
    EXPECT_LE (solution.reciprocal_condition, 1.0);
  }
}

// A matrix that is triangular up to a permutation has no fill.
TEST (UmfpackSolver, CountsTheDiagonalOnce)
{
  RandomStream random (5);
  Matrix matrix (3, 3);
  const std::vector<Eigen::Triplet<double>> entries{
      {0, 0, 1.0}, {1, 0, -0.5}, {1, 1, 2.0}, {2, 1, -1.0}, {2, 2, 4.0}};
  matrix.setFromTriplets (entries.begin (), entries.end ());
  const Solution solution = solveWithUmfpack (systemOf (matrix, random), Ordering::AMD, 1);
  EXPECT_EQ (solution.nnz_factors, 5u);
  EXPECT_DOUBLE_EQ (solution.reciprocal_condition, 0.25);
}

TEST (UmfpackSolver, DoesNotDependOnTheThreads)
{
  const TriangulatedGrid grid (50, 0.12, 6);
  const LinearSystem system = gridSystem (grid);
  const Solution one = solveWithUmfpack (system, Ordering::AMD, 1);
  const Solution two = solveWithUmfpack (system, Ordering::AMD, 2);
  ASSERT_EQ (one.outcome, Outcome::OK) << one.message;
  EXPECT_EQ (one.uv, two.uv);
}

TEST (UmfpackSolver, SolvesAnEmptySystem)
{
  LinearSystem system;
  system.row_offsets = {0};
  const Solution solution = solveWithUmfpack (system, Ordering::AUTOMATIC, 1);
  EXPECT_EQ (solution.outcome, Outcome::OK);
  EXPECT_TRUE (solution.uv.empty ());
  EXPECT_EQ (solution.residual, 0.0);
}

TEST (UmfpackSolver, ReportsARowWithoutWeights)
{
  RandomStream random (7);
  LinearSystem system = randomSystem (30, random);
  for (int entry = system.row_offsets[11]; entry < system.row_offsets[12]; ++entry)
    system.values[static_cast<std::size_t> (entry)] = 0.0;
  expectFailure (solveWithUmfpack (system, Ordering::AMD, 1), Outcome::SINGULAR);
  expectFailure (solveWithUmfpack (system, Ordering::METIS, 1), Outcome::SINGULAR);
}

TEST (UmfpackSolver, ReportsFloatingUnknowns)
{
  RandomStream random (8);
  for (const int floating : {4, 50, 500, 5000})
    for (const Ordering ordering : {Ordering::AMD, Ordering::METIS}) {
      SCOPED_TRACE (floating);
      expectFailure (solveWithUmfpack (systemWithFloating (floating, random), ordering, 1),
                     Outcome::SINGULAR);
    }
}

TEST (UmfpackSolver, ReportsAMalformedMatrix)
{
  RandomStream random (9);
  LinearSystem system = randomSystem (10, random);
  ASSERT_GE (system.row_offsets[1], 2);
  std::swap (system.columns[0], system.columns[1]);
  expectFailure (solveWithUmfpack (system, Ordering::AMD, 1), Outcome::FAILED);
}

TEST (UmfpackSolver, ReportsASolutionThatIsNotFinite)
{
  RandomStream random (10);
  LinearSystem system = randomSystem (10, random);
  system.rhs_v[3] = std::numeric_limits<double>::quiet_NaN ();
  expectFailure (solveWithUmfpack (system, Ordering::AMD, 1), Outcome::FAILED);
}

// Above a million unknowns, indices have 64 bits. The matrix is triangular, which is quick: each
// unknown is the mean of the one before it and of 1 or 0.
TEST (UmfpackSolver, SolvesWithLongIndices)
{
  constexpr int UNKNOWNS = 1000001, LENGTH = 4;
  LinearSystem system;
  system.row_offsets.push_back (0);
  for (int i = 0; i < UNKNOWNS; ++i) {
    if (i % LENGTH != 0) {
      system.columns.push_back (i - 1);
      system.values.push_back (-0.5);
    }
    system.columns.push_back (i);
    system.values.push_back (1.0);
    system.row_offsets.push_back (static_cast<int> (system.columns.size ()));
  }
  system.rhs_u.assign (UNKNOWNS, 0.5);
  system.rhs_v.assign (UNKNOWNS, 0.0);
  for (std::size_t i = 0; i < UNKNOWNS; i += LENGTH)
    system.rhs_v[i] = 1.0;
  system.point_of_unknown.resize (UNKNOWNS);
  const Solution solution = solveWithUmfpack (system, Ordering::AMD, 2);
  ASSERT_EQ (solution.outcome, Outcome::OK) << solution.message;
  EXPECT_EQ (solution.residual, 0.0);
  for (std::size_t i = 0; i < UNKNOWNS; ++i) {
    const double power = std::ldexp (1.0, -static_cast<int> (i % LENGTH));
    ASSERT_EQ (solution.uv[i], Eigen::Vector2d (1.0 - 0.5 * power, power));
  }
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

TEST_F (BlasThreads, AreOneInScopeAndRestoredAfterwards)
{
  {
    const SingleBlasThread outer;
    EXPECT_EQ (get_ (), 1);
    {
      const SingleBlasThread inner;
      EXPECT_EQ (get_ (), 1);
    }
    EXPECT_EQ (get_ (), 1);
  }
  EXPECT_EQ (get_ (), 2);
}

// The fronts are so large that OpenBLAS would use both threads, and the last digits would differ.
TEST_F (BlasThreads, DoNotChangeASolution)
{
  RandomStream random (12);
  const LinearSystem system = randomSystem (1500, random);
  const Solution two = solveWithUmfpack (system, Ordering::AMD, 1);
  set_ (1);
  const Solution one = solveWithUmfpack (system, Ordering::AMD, 1);
  ASSERT_EQ (one.outcome, Outcome::OK) << one.message;
  EXPECT_EQ (one.uv, two.uv);
}

TEST_F (BlasThreads, AreRestoredBySolversInAnyThread)
{
  RandomStream random (11);
  const LinearSystem good = randomSystem (200, random), bad = systemWithFloating (50, random);
  std::vector<std::thread> solvers;
  solvers.reserve (4);
  for (int i = 0; i < 4; ++i)
    solvers.emplace_back ([&good, &bad, i] {
      for (int round = 0; round < 10; ++round)
        EXPECT_EQ (solveWithUmfpack (i % 2 == 0 ? good : bad, Ordering::AMD, 1).outcome,
                   i % 2 == 0 ? Outcome::OK : Outcome::SINGULAR);
    });
  for (std::thread& solver : solvers)
    solver.join ();
  EXPECT_EQ (get_ (), 2);
}

} // namespace
} // namespace pcl::floater
