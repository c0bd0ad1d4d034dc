// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/iterative.h"

#include "floater/solvers/islands.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl
{
namespace floater
{
bool
refuseIslands (const LinearSystem& system, Solution& solution)
{
  const std::size_t floating = countFloatingUnknowns (system);
  if (floating == 0)
    return false;
  solution.outcome = Solution::Outcome::SINGULAR;
  solution.message = std::to_string (floating) + " unknowns do not depend on the boundary";
  return true;
}

void
concludeIteration (const LinearSystem& system, double tolerance, const char* name,
                   Solution& solution)
{
  const Residual residual = measureResidual (system, solution.uv);
  solution.residual = residual.largest;
  solution.relative_residual = std::max (residual.relative (0), residual.relative (1));
  if (residual.isWithin (tolerance, 0) && residual.isWithin (tolerance, 1)) {
    solution.outcome = Solution::Outcome::OK;
    return;
  }
  std::ostringstream message;
  message << name;
  if (std::isfinite (residual.largest)) {
    solution.outcome = Solution::Outcome::NOT_CONVERGED;
    message << " has come to a relative residual of " << solution.relative_residual << " in "
            << std::max (solution.iterations[0], solution.iterations[1]) << " iterations, not to "
            << tolerance;
  }
  else {
    solution.outcome = Solution::Outcome::FAILED;
    message << ": the solution is not finite";
  }
  solution.message = message.str ();
  solution.uv.clear ();
}

} // namespace floater
} // namespace pcl
