// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Gauss-Seidel iteration, the simplest of the solvers in TW 385, section 4.2.
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

namespace pcl::floater {
/// Sweeps over the rows in their order, in which each unknown becomes the weighted mean of its
/// neighbours, until the measured residual is within the tolerance. A sweep shrinks the error by a
/// factor of 1 - O(1/n) for n unknowns, so the number of sweeps grows with n. Outcomes OK,
/// SINGULAR, NOT_CONVERGED, FAILED.
/// \param tolerance      see Residual::isWithin ()
/// \param max_iterations sweeps, each over both coordinates
Solution
solveWithGaussSeidel (const LinearSystem& system, double tolerance, int max_iterations,
                      const RunContext& run);

} // namespace pcl::floater
