// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The solvers of the linear system (TW 385, section 4.2), behind one interface.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "floater/solvers/linear_system.h"

#include <pcl/surface/floater/options.h>

#include <array>
#include <string>

namespace pcl::floater {
/// The solution of a LinearSystem, and what it cost.
struct Solution
{
  enum class Outcome
  {
    OK,
    SINGULAR,
    NOT_CONVERGED,
    OUT_OF_MEMORY,
    UNAVAILABLE, ///< see checkSolver ()
    FAILED
  };
  Outcome outcome = Outcome::FAILED;
  std::string message; ///< reason, unless OK
  Eigen::MatrixX2d uv; ///< per unknown; no rows unless OK
  std::size_t nnz_factors =
      0;                 ///< entries of L and U, also of incomplete factors; the unit diagonal
                         ///< of L is not counted
  double residual = 0.0; ///< max |b - A u|
  double relative_residual = 0.0;          ///< |b - A u| / |b| of the worse right-hand side
  std::array<std::size_t, 2> iterations{}; ///< iterative solvers: for u and for v
  double reciprocal_condition = 0.0; ///< direct solvers: min |U_kk| / max |U_kk|; 1 if there is
                                     ///< no unknown
  std::size_t peak_bytes = 0;        ///< direct solvers: largest memory of the factorization
};

/// SOLVER_UNAVAILABLE if the library is without the solver, INVALID_OPTION for an ordering that no
/// solver takes, OK otherwise.
Problem
checkSolver (Solver solver, Ordering ordering);

/// Solves for both coordinates with options.method in the order options.ordering. An empty system
/// is OK. Every solver refuses a singular system: direct ones by a pivot of rounding errors, the
/// others look for floating unknowns first. An iterative solver whose measured residual is above
/// options.tolerance returns NOT_CONVERGED and no solution. The result does not depend on the number
/// of threads.
/// \throws std::bad_alloc, IndexLimitReached
Solution
solve (const LinearSystem& system, const SolverOptions& options, const RunContext& run);

} // namespace pcl::floater
