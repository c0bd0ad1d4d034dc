// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Direct solution by UMFPACK (TW 385, section 4.2).
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// How UMFPACK chooses pivots.
enum class UmfpackStrategy
{
  SYMMETRIC,  ///< on the diagonal; rows and columns in one order
  UNSYMMETRIC ///< in sparse rows; columns in an order of their own
};

/// Solves by one factorization for both right-hand sides; these are solved at the same time if
/// there are threads. UMFPACK takes columns, so the rows are passed as the transpose and solved
/// with UMFPACK_At, without scaling and with one BLAS thread. With more than a million unknowns,
/// indices have 64 bits. The symmetric strategy needs no refinement, and it detects floating
/// unknowns by their pivots. The unsymmetric strategy takes two steps of refinement, and floating
/// unknowns are looked for first. An empty system is OK. Failures of UMFPACK are outcomes. The
/// result does not depend on the number of threads.
/// \param ordering SYMMETRIC: AMD or AUTOMATIC (the same), METIS, or NATURAL;
///                 UNSYMMETRIC: COLAMD or AUTOMATIC (the same), METIS (of A^T A), or NATURAL
/// \throws std::bad_alloc
Solution
solveWithUmfpack (const LinearSystem& system, Ordering ordering, const RunContext& run,
                  UmfpackStrategy strategy = UmfpackStrategy::SYMMETRIC);

/// The same with the symmetric strategy and a given order.
/// \param order entry i is the unknown of the i-th pivot
Solution
solveWithUmfpack (const LinearSystem& system, const std::vector<int>& order, const RunContext& run);

} // namespace pcl::floater
