// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The linear system, and all solvers in all orders, on systems whose solution is known; the connection of all points
// with the loop.
#include "floater/solvers/solver.h"

#include "floater/floater_method.h"
#include "floater/weights.h"
#include "options/option_rows.h"
#include "samples.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

SolverOptions
choice (Solver solver, Ordering ordering = Ordering::AUTOMATIC)
{
  SolverOptions options;
  options.method = solver;
  options.ordering = ordering;
  return options;
}

// The system of all interior points of a flat square with so many points at a side, with the loop in its place.
// Weights that reproduce linear functions then leave all points in their places.
LinearSystem
squareSystem (int side, std::uint64_t seed, Weighting weighting = Weighting::MEAN_VALUE)
{
  const double step = 1.0 / (side - 1);
  const Sheet sheet = fillOutlines ({resample (rectangle (1.0, 1.0), step)}, step, 0.12, seed);
  const auto [points, geometry] = makeNeighborhoods (sheet.positions);
  std::vector<Index> loop (sheet.border);
  std::vector<Eigen::Vector2d> uv;
  for (Index p = 0; p < points.size (); ++p)
    if (points.cloud_index[p] < sheet.border)
      loop[points.cloud_index[p]] = p;
  for (const Index p : loop)
    uv.emplace_back (points.positions[p].head<2> ());
  return assembleSystem (geometry.stars.neighbors, computeWeights (geometry.stars, weighting, 1),
                         loop, uv, std::vector<std::uint8_t> (points.size (), 1));
}

using Entries = std::vector<Eigen::Triplet<double>>;

LinearSystem
systemOf (const Entries& entries, const Eigen::MatrixX2d& rhs)
{
  LinearSystem system;
  system.rhs = rhs;
  system.matrix.resize (rhs.rows (), rhs.rows ());
  system.matrix.setFromTriplets (entries.begin (), entries.end ());
  return system;
}

void
expectFailure (const Solution& solution, RunStatus status)
{
  EXPECT_EQ (solution.problem.status, status);
  EXPECT_FALSE (solution.problem.message.empty ());
  EXPECT_EQ (solution.uv.rows (), 0);
}

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
  EXPECT_EQ (system.point_of_unknown, (std::vector<Index>{1, 3}));
  // The diagonal contains the weights of the loop, but not those of point 4.
  EXPECT_EQ (Eigen::MatrixXd (system.matrix), (Eigen::Matrix2d{{0.75, -0.5}, {-0.375, 0.75}}));
  EXPECT_EQ (system.rhs, (Eigen::Matrix2d{{1.0, 2.0}, {-4.0, 4.0}}));
}

TEST (LinearSystem, WithoutEquationsOrNeighborsOrWithTooManyEntries)
{
  const std::vector<Eigen::Vector2d> loop_uv{{0, 0}, {1, 0}, {0, 1}};
  CsrLists neighbors; // of a triangle of loop points alone
  neighbors.offsets = {0, 2, 4, 6};
  neighbors.ids = {1, 2, 0, 2, 0, 1};
  const auto assemble = [&] (std::size_t most) {
    return assembleSystem (neighbors, std::vector<double> (neighbors.ids.size (), 0.5), {0, 1, 2},
                           loop_uv, std::vector<std::uint8_t> (neighbors.rows (), 1), most);
  };
  EXPECT_EQ (assemble (0).unknowns (), 0U);
  EXPECT_EQ (assemble (0).nonzeros (), 0U);
  neighbors.offsets.push_back (6); // a point without neighbours
  EXPECT_EQ (assemble (1).nonzeros (), 1U);
  EXPECT_EQ (assemble (1).matrix.coeff (0, 0), 0.0);
  neighbors.offsets = {0, 2, 4, 6, 8, 10}; // two that have each other
  neighbors.ids.insert (neighbors.ids.end (), {0, 4, 1, 3});
  EXPECT_EQ (assemble (4).nonzeros (), 4U);
  EXPECT_THROW (assemble (3), IndexLimitReached);
}

TEST (Solvers, AgreeWithADenseFactorizationInEveryOrder)
{
  RandomStream random (3);
  std::vector<LinearSystem> systems{
      squareSystem (14, 1), squareSystem (14, 1, Weighting::SHAPE_PRESERVING),
      systemOf ({{0, 0, 1.0}, {1, 1, 2.0}, {2, 2, 4.0}}, // no unknown has a neighbour
                Eigen::MatrixX2d::Ones (3, 2))};
  for (const int n : {1, 2, 10, 300}) { // random entries and a dominant diagonal, not symmetric
    Entries all;
    for (int i = 0; i < n; ++i) {
      std::map<int, double> entries;
      double sum = 0.1;
      for (int entry = 0; entry < 5; ++entry)
        sum += std::abs (entries[static_cast<int> (random.below (static_cast<std::size_t> (n)))] =
                             2.0 * random.uniform () - 1.0);
      entries[i] = 2.0 * sum;
      for (const auto& [column, value] : entries)
        all.emplace_back (i, column, value);
    }
    systems.push_back (systemOf (
        all, Eigen::MatrixX2d::NullaryExpr (n, 2, [&] { return random.uniform () - 0.5; })));
  }
  systems[5].rhs.col (0).setZero ();
  for (std::size_t i = 0; i < systems.size (); ++i)
    for (const auto& [solver_name, solver] : SOLVER_CHOICES)
      for (const auto& [name, ordering] : ORDERING_CHOICES) {
        SCOPED_TRACE (testing::Message () << i << ", " << solver_name << ", " << name);
        const LinearSystem& system = systems[i];
        const Solution solution = solve (system, choice (solver, ordering), 1);
        ASSERT_FALSE (solution.problem) << solution.problem.message;
        const Eigen::MatrixXd dense (system.matrix);
        const Eigen::MatrixX2d expected = dense.partialPivLu ().solve (system.rhs);
        EXPECT_LT ((solution.uv - expected).cwiseAbs ().maxCoeff (), i < 2 ? 1e-12 : 1e-13);
        const Eigen::MatrixX2d rest = system.rhs - dense * solution.uv;
        EXPECT_NEAR (solution.residual, rest.cwiseAbs ().maxCoeff (), 2e-15);
        EXPECT_LT (solution.relative_residual, 1e-14);
        if (i >= 2)
          continue;
        EXPECT_GT (solution.relative_residual, 0.0);
        EXPECT_EQ (solution.iterations_u > 0, solver == Solver::BICGSTAB_ILUT);
        EXPECT_EQ (solution.iterations_v > 0, solver == Solver::BICGSTAB_ILUT);
        if (solver == Solver::UMFPACK) {
          EXPECT_GE (solution.nnz_factors, system.nonzeros ());
          EXPECT_GE (solution.factorization_bytes, 8 * solution.nnz_factors);
          EXPECT_LT (solution.factorization_bytes, 200 * solution.nnz_factors);
          EXPECT_GT (solution.reciprocal_condition, 1e-3);
          EXPECT_LE (solution.reciprocal_condition, 1.0);
        }
      }
}

TEST (Solvers, UseTheOrderThatIsAskedFor)
{
  LinearSystem system = squareSystem (30, 2);
  const std::vector<Index> shuffled = permutation (system.unknowns (), 5);
  Eigen::PermutationMatrix<Eigen::Dynamic> order (system.matrix.rows ());
  std::copy (shuffled.begin (), shuffled.end (), order.indices ().begin ());
  system.matrix = SystemMatrix (system.matrix).twistedBy (order);
  system.rhs = order * Eigen::MatrixX2d (system.rhs);
  const auto fill = [&system] (Ordering ordering) {
    return solve (system, choice (Solver::UMFPACK, ordering), 1).nnz_factors;
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

// Above a million unknowns, indices have 64 bits. The matrix is triangular, which is quick: each
// unknown is the mean of the one before it and of 1 or 0.
TEST (Solvers, WithLongIndices)
{
  constexpr int UNKNOWNS = 1000001, LENGTH = 4;
  Entries entries;
  Eigen::MatrixX2d rhs (UNKNOWNS, 2);
  for (int i = 0; i < UNKNOWNS; ++i) {
    entries.emplace_back (i, i, 1.0);
    if (i % LENGTH != 0)
      entries.emplace_back (i, i - 1, -0.5);
    rhs.row (i) << 0.5, i % LENGTH == 0 ? 1.0 : 0.0;
  }
  const Solution solution =
      solve (systemOf (entries, rhs), choice (Solver::UMFPACK, Ordering::AMD), 2);
  ASSERT_FALSE (solution.problem) << solution.problem.message;
  EXPECT_EQ (solution.residual, 0.0);
  for (int i = 0; i < UNKNOWNS; ++i) {
    const double power = std::ldexp (1.0, -(i % LENGTH));
    ASSERT_EQ (solution.uv.row (i), Eigen::RowVector2d (1.0 - 0.5 * power, power));
  }
}

TEST (Solvers, SolveNothing)
{
  const LinearSystem empty;
  for (const auto& [name, solver] : SOLVER_CHOICES)
    EXPECT_FALSE (solve (empty, choice (solver), 1).problem);
}

TEST (Solvers, RefuseWhatTheyCannotSolve)
{
  LinearSystem without_weights = squareSystem (8, 4), infinite = without_weights;
  without_weights.matrix.row (11) *= 0.0;
  infinite.rhs (3, 1) = std::numeric_limits<double>::quiet_NaN ();
  for (const auto& [solver_name, solver] : SOLVER_CHOICES) {
    SCOPED_TRACE (solver_name);
    SolverOptions options = choice (solver);
    options.max_iterations = 50;
    if (solver == Solver::UMFPACK)
      expectFailure (solve (without_weights, options, 1), RunStatus::SINGULAR);
    expectFailure (solve (infinite, options, 1), RunStatus::INTERNAL_ERROR);
  }
  LinearSystem unsorted = squareSystem (8, 4);
  std::swap (unsorted.matrix.innerIndexPtr ()[0], unsorted.matrix.innerIndexPtr ()[1]);
  expectFailure (solve (unsorted, choice (Solver::UMFPACK), 1), RunStatus::INTERNAL_ERROR);
}

TEST (Solvers, BicgstabStopsAtTheToleranceOrTellsThatItDoesNot)
{
  const LinearSystem system = squareSystem (30, 7);
  std::size_t iterations = 0; // at the last tolerance
  SolverOptions options = choice (Solver::BICGSTAB_ILUT);
  for (const double tolerance : {1e-3, 1e-7, 1e-11, 1e-15}) {
    options.tolerance = tolerance;
    const Solution solution = solve (system, options, 1);
    ASSERT_FALSE (solution.problem) << solution.problem.message;
    EXPECT_LE (solution.relative_residual, std::max (tolerance, 1e-13));
    EXPECT_GT (solution.iterations_u, iterations) << tolerance;
    iterations = solution.iterations_u;
  }
  EXPECT_LT (iterations, 25U);
  options.max_iterations = 4;
  const Solution solution = solve (system, options, 1);
  expectFailure (solution, RunStatus::NOT_CONVERGED);
  EXPECT_EQ (solution.iterations_u, 4U);
  EXPECT_GT (solution.relative_residual, options.tolerance);
  EXPECT_NE (solution.problem.message.find ("residual"), std::string::npos);
}

TEST (Reachability, MatchesItsDefinitionOnRandomGraphs)
{
  RandomStream random (2);
  for (std::uint32_t round = 0; round < 50; ++round) {
    const std::size_t count = 5 + random.below (60);
    CsrLists rows{{0}, {}};
    while (rows.rows () < count) {
      for (std::size_t i = random.below (2 + round % 2); i > 0; --i)
        rows.ids.push_back (static_cast<Index> (random.below (count)));
      rows.offsets.push_back (static_cast<Index> (rows.ids.size ()));
    }
    // The definition instead of the algorithm: follows the rows until nothing changes.
    std::vector<std::uint8_t> reachable (count, 0);
    reachable[0] = reachable[1] = 1;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t p = 0; p < count; ++p)
        for (const Index q : rows.row (p))
          if (reachable[p] == 0 && reachable[q] != 0) {
            reachable[p] = 1;
            changed = true;
          }
    }
    EXPECT_EQ (reachLoop (rows, {0, 1}, 1), reachable);
  }
}

} // namespace
} // namespace pcl::floater
