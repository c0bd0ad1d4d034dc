// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One interface to all solvers (TW 385, section 4.2).
#pragma once

#include "core/problem.h"
#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// Whether this build has the library of the solver.
bool
isAvailable (Solver solver);

/// INVALID_OPTION if the solver does not take the ordering, SOLVER_UNAVAILABLE if this build is
/// without the solver, OK otherwise.
Problem
checkSolver (Solver solver, Ordering ordering);

/// Solves for both coordinates with options.method in the order options.ordering. An empty system
/// is OK. Every solver refuses a singular system: those with pivots on the diagonal notice a pivot
/// of rounding errors, the others look for floating unknowns first. An iterative solver whose
/// measured residual does not reach options.tolerance (see Residual::isWithin ()) returns
/// NOT_CONVERGED and no solution. The result does not depend on the number of threads.
/// \param positions per point, for nested dissection; nullptr: UMFPACK's automatic ordering is
///                  always AMD
/// \throws std::bad_alloc
Solution
solve (const LinearSystem& system, const SolverOptions& options,
       const std::vector<Eigen::Vector3d>* positions, const RunContext& run);

} // namespace pcl::floater
