// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How every iterative solver ends.
#pragma once

#include "floater/solvers/residual.h"

namespace pcl::floater {
/// Measures the residual of solution.uv and sets the outcome: OK if the residual is within the
/// tolerance, NOT_CONVERGED if it is not, FAILED if it is not finite. Unless it is OK, there is a
/// message and no uv.
/// \param tolerance see Residual::isWithin ()
/// \param name      of the solver, for the message
void
concludeIteration (const LinearSystem& system, double tolerance, const char* name,
                   Solution& solution);

} // namespace pcl::floater
