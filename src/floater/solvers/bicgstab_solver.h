// SPDX-License-Identifier: GPL-3.0-or-later
// BiCGSTAB with an incomplete factorization, as TW 385 compares it with UMFPACK (Table 3).
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

#include <pcl/surface/floater/options.h>

namespace pcl
{
namespace floater
{
/// Eigen's BiCGSTAB and IncompleteLUT: one incomplete factorization, then each coordinate apart, at
/// the same time if there are threads. What BiCGSTAB updates as its residual drifts from the true
/// one, so this is measured when it stops, and it starts again on the rest until the tolerance is
/// reached, the iterations are used up, or a round does not halve the residual.
///
/// Takes tolerance, max_iterations (of all rounds; Eigen may overrun it by once as much when it
/// restarts by itself), ilut_fill, ilut_drop and threads of the options. Eigen counts fill in
/// multiples of the matrix's mean row, so ilut_fill is rounded up to such. Iterations are counted
/// by the applications of the preconditioner, two for each. Outcomes OK, SINGULAR, NOT_CONVERGED,
/// FAILED; may throw std::bad_alloc.
Solution
solveWithBicgstab (const LinearSystem& system, const SolverOptions& options, const RunContext& run);

} // namespace floater
} // namespace pcl
