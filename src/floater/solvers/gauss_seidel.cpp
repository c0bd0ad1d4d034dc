// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/solver_parts.h"

namespace pcl::floater {
namespace {
// Sweeps between two measurements of the residual, each of which costs as much as a sweep.
constexpr int SWEEPS_BETWEEN_CHECKS = 10;

void
sweep (const LinearSystem& system, const RunContext& run, Eigen::MatrixX2d& uv)
{
  ProgressLoop progress (run);
  for (std::size_t row = 0; row < system.unknowns (); ++row) {
    progress.next ();
    const auto i = static_cast<Eigen::Index> (row);
    Eigen::RowVector2d sum = system.rhs.row (i);
    double diagonal = 0.0;
    system.visitRow (row, [&] (std::size_t column, double value) {
      if (column == row)
        diagonal = value;
      else
        sum -= value * uv.row (static_cast<Eigen::Index> (column));
    });
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
