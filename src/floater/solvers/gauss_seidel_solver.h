// SPDX-License-Identifier: GPL-3.0-or-later
// Gauss-Seidel iteration, the simplest of the solvers in TW 385, section 4.2.
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

namespace pcl
{
namespace floater
{
/// Sweeps over the rows in their order, each unknown becoming the mean of its neighbours, until the
/// measured residual is within the tolerance. The error shrinks by a factor of 1 - O(1/n) a sweep,
/// so that the sweeps needed grow with the number of unknowns.
/// Outcomes OK, SINGULAR, NOT_CONVERGED, FAILED. \param max_iterations sweeps, for u and v together
Solution
solveWithGaussSeidel (const LinearSystem& system, double tolerance, int max_iterations,
                      const RunContext& run);

} // namespace floater
} // namespace pcl
