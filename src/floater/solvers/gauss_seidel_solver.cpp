// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/gauss_seidel_solver.h"

#include "core/run_context.h"
#include "floater/solvers/floating_unknowns.h"
#include "floater/solvers/iterative.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// Sweeps between two measurements of the residual, each of which costs as much as a sweep.
constexpr int SWEEPS_BETWEEN_CHECKS = 10;

void
sweep (const LinearSystem& system, std::vector<Eigen::Vector2d>& uv, const RunContext& run)
{
  ProgressLoop progress (run);
  for (std::size_t i = 0; i < uv.size (); ++i) {
    progress.next ();
    Eigen::Vector2d sum (system.rhs_u[i], system.rhs_v[i]);
    double diagonal = 0.0;
    const auto last = static_cast<std::size_t> (system.row_offsets[i + 1]);
    for (auto entry = static_cast<std::size_t> (system.row_offsets[i]); entry < last; ++entry) {
      const auto j = static_cast<std::size_t> (system.columns[entry]);
      if (j == i)
        diagonal = system.values[entry];
      else
        sum -= system.values[entry] * uv[j];
    }
    uv[i] = sum / diagonal;
  }
}

} // namespace

Solution
solveWithGaussSeidel (const LinearSystem& system, double tolerance, int max_iterations,
                      const RunContext& run)
{
  Solution solution;
  if (refuseFloatingUnknowns (system, solution))
    return solution;
  solution.uv.assign (system.unknowns (), Eigen::Vector2d::Zero ());
  std::array<bool, 2> solved{};
  for (int sweeps = 0; sweeps < max_iterations && !(solved[0] && solved[1]);) {
    const int next = std::min (sweeps + SWEEPS_BETWEEN_CHECKS, max_iterations);
    for (; sweeps < next; ++sweeps)
      sweep (system, solution.uv, run);
    const Residual residual = measureResidual (system, solution.uv);
    for (std::size_t side = 0; side < 2; ++side)
      if (!solved[side]) {
        solution.iterations[side] = static_cast<std::size_t> (sweeps);
        solved[side] = residual.isWithin (tolerance, side);
      }
  }
  concludeIteration (system, tolerance, "Gauss-Seidel", solution);
  return solution;
}

} // namespace pcl::floater
