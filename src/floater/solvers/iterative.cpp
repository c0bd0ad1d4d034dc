// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/iterative.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl::floater {
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
  if (std::isfinite (residual.largest)) {
    solution.outcome = Solution::Outcome::NOT_CONVERGED;
    const std::size_t iterations = std::max (solution.iterations[0], solution.iterations[1]);
    message << name << " reached a relative residual of " << solution.relative_residual << " in "
            << iterations << (iterations == 1 ? " iteration" : " iterations") << ", not "
            << tolerance;
  }
  else {
    solution.outcome = Solution::Outcome::FAILED;
    message << name << ": the solution is not finite";
  }
  solution.message = message.str ();
  solution.uv.clear ();
}

} // namespace pcl::floater
