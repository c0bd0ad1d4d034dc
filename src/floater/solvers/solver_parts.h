// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What solve () is made of: the solvers, the orderings, and what is measured.
#pragma once

#include "floater/solvers/solver.h"

#include <algorithm>

namespace pcl::floater {
// Each solver fills `uv` and the figures of the solution, or tells the problem. solve () looks at the
// residual and the pivots.

/// Why there is no solution.
/// \param status SINGULAR, NOT_CONVERGED, OUT_OF_MEMORY, or INTERNAL_ERROR
Problem
notSolved (RunStatus status, const std::string& why);

/// One factorization for both right-hand sides, with one BLAS thread. The rows are the columns of the
/// transpose, whose dominant diagonal keeps pivots on the diagonal.
/// \param ordering AMD, or NATURAL: as the unknowns come
void
solveWithUmfpack (const LinearSystem& system, Ordering ordering, const RunContext& run,
                  Solution& solution);

/// BiCGSTAB with Eigen's IncompleteLUT: one incomplete factorization, then each coordinate by
/// itself. The residual that BiCGSTAB updates drifts away from the true one. So the true one is
/// measured when it stops, and it starts again on what is left until the tolerance is reached, the
/// iterations of all rounds are used up, or a round does not halve the residual. Eigen counts fill
/// in mean rows of the matrix, so ilut_fill is rounded up to a multiple of these.
void
solveWithBicgstab (const LinearSystem& system, const SolverOptions& options, const RunContext& run,
                   Solution& solution);

/// Sweeps over the rows in their order, in which each unknown becomes the weighted mean of its
/// neighbours. A sweep shrinks the error by a factor of 1 - O(1/n) for n unknowns, so the number of
/// sweeps grows with n.
void
solveWithGaussSeidel (const LinearSystem& system, const SolverOptions& options,
                      const RunContext& run, Solution& solution);

/// The residual of one coordinate, computed from the matrix itself.
struct Residual
{
  Eigen::VectorXd rest;  ///< b - A u
  double rhs = 0.0;      ///< |b|
  double rounding = 0.0; ///< bound of the rounding error of |b - A u|: 4 eps | |A| |u| + |b| |

  /// The norm at which an iteration is done: that of the tolerance, or as small as double precision
  /// lets it be. Storing u with 16 digits alone gives a large system a relative one above 1e-15.
  double target (double tolerance) const { return std::max (tolerance * rhs, rounding); }
};

/// O(entries).
Residual
measureResidual (const LinearSystem& system, Eigen::Index side,
                 const Eigen::Ref<const Eigen::VectorXd>& solution);

/// An order of the unknowns (TW 385, section 4.2 and Figure 4), made from the pattern of A + A^T.
/// indices () [i] is the unknown that comes i-th. AMD and METIS are called through CHOLMOD, and follow
/// the elimination tree. METIS draws from rand (), of which it gets a state of its own; another
/// thread that draws meanwhile changes the order, so that only one thread is in METIS at a time.
/// \param ordering AMD, METIS or REVERSE_CUTHILL_MCKEE
/// \throws std::bad_alloc
Eigen::PermutationMatrix<Eigen::Dynamic>
orderUnknowns (const SystemMatrix& matrix, Ordering ordering);

} // namespace pcl::floater
