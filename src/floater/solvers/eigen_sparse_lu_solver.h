// SPDX-License-Identifier: GPL-3.0-or-later
// Direct solution by Eigen's SparseLU.
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

#include <pcl/surface/floater/options.h>

namespace pcl
{
namespace floater
{
/// One factorization, two right-hand sides. The rows are passed as the columns of the transpose,
/// where a dominant diagonal makes partial pivoting keep to it. Outcomes OK, SINGULAR,
/// OUT_OF_MEMORY, FAILED; may throw std::bad_alloc.
/// \param ordering NATURAL: as the unknowns come; all others: COLAMD
Solution
solveWithEigenSparseLu (const LinearSystem& system, Ordering ordering, const RunContext& run);

} // namespace floater
} // namespace pcl
