// SPDX-License-Identifier: GPL-3.0-or-later
// What solvers have in common that cannot tell by themselves when they are wrong.
#pragma once

#include "floater/solvers/residual.h"

namespace pcl
{
namespace floater
{
/// Makes the outcome SINGULAR if some unknowns do not hang on the boundary (see islands.h).
/// \return true if so
bool
refuseIslands (const LinearSystem& system, Solution& solution);

/// Measures the residual of solution.uv. OK if it is within the tolerance, NOT_CONVERGED with a
/// message and without uv if it is not, FAILED if it is not finite.
/// \param name of the method, for the message
void
concludeIteration (const LinearSystem& system, double tolerance, const char* name,
                   Solution& solution);

} // namespace floater
} // namespace pcl
