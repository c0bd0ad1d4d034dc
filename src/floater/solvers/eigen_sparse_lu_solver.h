// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Direct solution by Eigen's SparseLU.
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// Solves by one factorization for both right-hand sides. The rows are passed as the columns of the
/// transpose: their dominant diagonal makes partial pivoting keep to the diagonal. Outcomes OK,
/// SINGULAR, OUT_OF_MEMORY, FAILED.
/// \param ordering NATURAL: as the unknowns come; any other: COLAMD
/// \throws std::bad_alloc
Solution
solveWithEigenSparseLu (const LinearSystem& system, Ordering ordering, const RunContext& run);

} // namespace pcl::floater
