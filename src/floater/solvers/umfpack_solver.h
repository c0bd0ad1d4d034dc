// SPDX-License-Identifier: GPL-3.0-or-later
// Direct solution by UMFPACK (TW 385, section 4.2).
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

#include <pcl/surface/floater/options.h>

namespace pcl
{
namespace floater
{
/// How UMFPACK looks for pivots.
enum class UmfpackStrategy
{
  SYMMETRIC,  ///< on the diagonal, columns and rows in one order
  UNSYMMETRIC ///< where they are sparse, columns in an order of their own
};

/// One factorization, two right-hand sides. UMFPACK takes columns, so the rows are passed as the
/// transpose and solved with UMFPACK_At. No scaling, one BLAS thread (of OpenBLAS; restored
/// afterwards). The symmetric strategy needs no refinement and knows islands by their pivots; the
/// unsymmetric one is refined in two steps, and islands are looked for before. Above a million
/// unknowns, indices have 64 bits. An empty system is OK. May throw std::bad_alloc; UMFPACK's own
/// failures are outcomes.
///
/// \param ordering SYMMETRIC: AMD or AUTOMATIC (the same), METIS or NATURAL; UNSYMMETRIC: COLAMD or
///        AUTOMATIC (the same), METIS (of A^T A) or NATURAL
/// \param threads 2 or more: the two right-hand sides are solved at the same time; same result
Solution
solveWithUmfpack (const LinearSystem& system, Ordering ordering, const RunContext& run,
                  UmfpackStrategy strategy = UmfpackStrategy::SYMMETRIC);

/// The same with the symmetric strategy, unknown order[i] as the i-th pivot.
Solution
solveWithUmfpack (const LinearSystem& system, const std::vector<int>& order, const RunContext& run);

} // namespace floater
} // namespace pcl
