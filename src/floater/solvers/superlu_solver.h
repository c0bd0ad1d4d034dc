// SPDX-License-Identifier: GPL-3.0-or-later
// Direct solution by SuperLU, which TW 385 compares with UMFPACK (section 4.2).
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

#include <pcl/surface/floater/options.h>

namespace pcl
{
namespace floater
{
/// One factorization, two right-hand sides. The rows are passed as the columns of the transpose,
/// where a dominant diagonal makes partial pivoting keep to it; one BLAS thread. SuperLU itself
/// ends the process if it cannot get small working arrays; the factors running out of memory is an
/// outcome. Outcomes OK, SINGULAR, OUT_OF_MEMORY, FAILED; may throw std::bad_alloc.
/// \param ordering NATURAL: as the unknowns come; COLAMD; all others: minimum degree on A + A^T
Solution
solveWithSuperlu (const LinearSystem& system, Ordering ordering);

} // namespace floater
} // namespace pcl
