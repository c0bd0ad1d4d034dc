// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parallel.h"
#include "floater/solvers/solver_parts.h"

#include <Eigen/IterativeLinearSolvers>

#include <cmath>
#include <utility>

namespace pcl::floater {
namespace {
using Vector = Eigen::VectorXd;

class IncompleteFactors : public Eigen::IncompleteLUT<double>
{
public:
  std::size_t nonZeros () const { return static_cast<std::size_t> (m_lu.nonZeros ()); }
};

// The factors as a preconditioner, at whose every use the run is polled for cancellation.
struct Preconditioner
{
  template <typename AnyMatrix>
  Preconditioner& compute (const AnyMatrix&)
  {
    return *this;
  }
  Eigen::ComputationInfo info () const { return Eigen::Success; }
  Vector solve (const Vector& rest) const
  {
    run->poll ();
    return factors->solve (rest);
  }

  const IncompleteFactors* factors = nullptr;
  const RunContext* run = nullptr;
};

// Solves for one right-hand side.
// \return the solution, and iterations
std::pair<Vector, int>
iterate (const LinearSystem& system, Eigen::Index side, const IncompleteFactors& factors,
         const SolverOptions& options, const RunContext& run)
{
  Eigen::BiCGSTAB<SystemMatrix, Preconditioner> solver; // van der Vorst 1992
  solver.preconditioner () = {&factors, &run};
  solver.compute (system.matrix);
  Vector rest = system.rhs.col (side), solution = Vector::Zero (rest.size ()), step;
  double norm = rest.norm (), target = options.tolerance * norm;
  int iterations = 0;
  while (norm > target && iterations < options.max_iterations) {
    solver.setTolerance (target / norm);
    solver.setMaxIterations (options.max_iterations - iterations);
    step = solver.solve (rest);
    iterations += static_cast<int> (solver.iterations ());
    step += solution;
    Residual residual = measureResidual (system, side, step);
    const double next_norm = residual.rest.norm ();
    if (!(next_norm < norm))
      break;
    std::swap (solution, step);
    rest = std::move (residual.rest);
    const bool stalls = next_norm > 0.5 * norm;
    norm = next_norm;
    target = residual.target (options.tolerance);
    if (stalls)
      break;
  }
  return {std::move (solution), iterations};
}

} // namespace

void
solveWithBicgstab (const LinearSystem& system, const SolverOptions& options, const RunContext& run,
                   Solution& solution)
{
  const Eigen::Index n = system.rhs.rows ();
  IncompleteFactors factors;
  // Eigen counts the fill in mean rows of the matrix. Half of it goes to L, and half to U.
  const double mean_row = static_cast<double> (system.nonzeros ()) / static_cast<double> (n);
  const double fill = std::ceil (2.0 * options.ilut_fill / mean_row);
  // Eigen reserves so many entries, and counts them in an int without looking.
  const std::size_t reserved_in_row =
      std::min (system.unknowns (), static_cast<std::size_t> (fill * mean_row) + 1) + 1;
  requireCountable (system.unknowns () * reserved_in_row, MOST_MATRIX_ENTRIES,
                    "the incomplete factorization", "use a smaller fill, or fewer points");
  factors.setFillfactor (static_cast<int> (fill));
  factors.setDroptol (options.ilut_drop);
  factors.compute (system.matrix);
  solution.nnz_factors = factors.nonZeros ();

  solution.uv.resize (n, 2);
  parallelTasks (run, 2, [&] (std::size_t side) {
    const auto at = static_cast<Eigen::Index> (side);
    const auto [unknowns, iterations] = iterate (system, at, factors, options, run);
    solution.uv.col (at) = unknowns;
    solution.iterations[side] = static_cast<std::size_t> (iterations);
  });
}

namespace {
// Sweeps between two measurements of the residual, each of which costs as much as a sweep.
constexpr int SWEEPS_BETWEEN_CHECKS = 10;

void
sweep (const LinearSystem& system, const RunContext& run, Eigen::MatrixX2d& uv)
{
  ProgressLoop progress (run);
  for (Eigen::Index i = 0; i < system.matrix.rows (); ++i) {
    progress.next ();
    Eigen::RowVector2d sum = system.rhs.row (i);
    double diagonal = 0.0;
    for (SystemMatrix::InnerIterator entry (system.matrix, i); entry; ++entry)
      if (entry.col () == i)
        diagonal = entry.value ();
      else
        sum -= entry.value () * uv.row (entry.col ());
    uv.row (i) = sum / diagonal;
  }
}

} // namespace

void
solveWithGaussSeidel (const LinearSystem& system, const SolverOptions& options,
                      const RunContext& run, Solution& solution)
{
  solution.uv = Eigen::MatrixX2d::Zero (system.rhs.rows (), 2);
  std::array<bool, 2> solved{};
  for (int sweeps = 0; sweeps < options.max_iterations && !(solved[0] && solved[1]);) {
    const int next = std::min (sweeps + SWEEPS_BETWEEN_CHECKS, options.max_iterations);
    for (; sweeps < next; ++sweeps)
      sweep (system, run, solution.uv);
    for (std::size_t side = 0; side < 2; ++side)
      if (!solved[side]) {
        const auto at = static_cast<Eigen::Index> (side);
        const Residual residual = measureResidual (system, at, solution.uv.col (at));
        solution.iterations[side] = static_cast<std::size_t> (sweeps);
        solved[side] = residual.rest.norm () <= residual.target (options.tolerance);
      }
  }
}

} // namespace pcl::floater
