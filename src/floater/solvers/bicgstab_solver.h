// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// BiCGSTAB with an incomplete factorization, which TW 385 compares with UMFPACK (Table 3).
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// Solves with Eigen's BiCGSTAB and IncompleteLUT: one incomplete factorization, then each
/// coordinate by itself, both at the same time if there are threads. The residual that BiCGSTAB
/// updates drifts away from the true one. So the true one is measured when it stops, and it starts
/// again on what is left until the tolerance is reached, the iterations are used up, or a round
/// does not halve the residual.
///
/// Iterations are those of all rounds; Eigen may exceed their number by as many again when it
/// restarts by itself. They are counted by the uses of the preconditioner, two for each. Eigen
/// counts fill in mean rows of the matrix, so ilut_fill is rounded up to a multiple of these.
/// Outcomes OK, SINGULAR, NOT_CONVERGED, FAILED.
/// \param options tolerance, max_iterations, ilut_fill and ilut_drop are used
/// \throws std::bad_alloc
Solution
solveWithBicgstab (const LinearSystem& system, const SolverOptions& options, const RunContext& run);

} // namespace pcl::floater
