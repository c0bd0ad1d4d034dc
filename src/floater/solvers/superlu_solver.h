// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Direct solution by SuperLU, which TW 385 compares with UMFPACK (section 4.2).
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// Solves by one factorization for both right-hand sides, with one BLAS thread. The rows are passed
/// as the columns of the transpose: their dominant diagonal makes partial pivoting keep to the
/// diagonal. If the factors do not fit into memory, that is an outcome; if SuperLU cannot get one
/// of its small working arrays, it ends the process. Outcomes OK, SINGULAR, OUT_OF_MEMORY, FAILED.
/// \param ordering NATURAL: as the unknowns come; COLAMD; any other: minimum degree on A + A^T
/// \throws std::bad_alloc
Solution
solveWithSuperlu (const LinearSystem& system, Ordering ordering);

} // namespace pcl::floater
