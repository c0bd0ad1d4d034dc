// SPDX-License-Identifier: GPL-3.0-or-later
// One interface to all solvers (TW 385, section 4.2).
#pragma once

#include "core/problem.h"
#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

#include <pcl/surface/floater/options.h>

namespace pcl
{
namespace floater
{
/// True if this build has the library of the solver.
bool
isAvailable (Solver solver);

/// INVALID_OPTION if the solver cannot take the ordering, SOLVER_UNAVAILABLE if this build is
/// without the solver.
Problem
checkSolver (Solver solver, Ordering ordering);

/// Solves for both coordinates with options.method in the order options.ordering. An empty system
/// is OK. A singular system is refused by every solver: those with pivots on the diagonal see one
/// of rounding errors, the others look for islands first. An iterative solver that does not reach
/// options.tolerance, as measured (see Residual::isWithin), returns NOT_CONVERGED and no solution.
/// May throw std::bad_alloc. The result does not depend on the number of threads.
/// \param positions per point; nullptr: not known, and UMFPACK's automatic ordering is always AMD
Solution
solve (const LinearSystem& system, const SolverOptions& options,
       const std::vector<Eigen::Vector3d>* positions, const RunContext& run);

} // namespace floater
} // namespace pcl
