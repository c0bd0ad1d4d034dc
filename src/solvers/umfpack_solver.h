// SPDX-License-Identifier: GPL-3.0-or-later
// Direct solution by UMFPACK (TW 385, section 4.2).
#pragma once

#include "parameterization/system.h"

#include <pcl/surface/floater/options.h>

#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// Solution of a LinearSystem and what the factorization cost.
struct Solution
{
  enum class Outcome
  {
    OK,
    SINGULAR,
    OUT_OF_MEMORY,
    FAILED
  };
  Outcome outcome = Outcome::FAILED;
  std::string message;               ///< why, unless OK
  std::vector<Eigen::Vector2d> uv;   ///< per unknown; empty unless OK
  std::size_t nnz_factors = 0;       ///< nnz (L + U), unit diagonal of L not counted twice
  double residual = 0.0;             ///< max |b - A u|
  double reciprocal_condition = 0.0; ///< min |U_kk| / max |U_kk|; 1 for an empty system
  std::size_t peak_bytes = 0;        ///< of symbolic and numeric factorization, as used
};

/// Reciprocal condition below which a system counts as singular. An island of unknowns leaves a
/// pivot of rounding errors, seldom exactly 0 (up to 3e-14 with 5000 unknowns); unknowns that hang
/// on the loop by the smallest weights (see weights.h) stay above.
constexpr double SINGULAR_RECIPROCAL_CONDITION = 1e-12;

/// One factorization, two right-hand sides. UMFPACK takes columns, so the rows are passed as the
/// transpose and solved with UMFPACK_At. Symmetric strategy, no scaling, no refinement, one BLAS
/// thread (of OpenBLAS; restored afterwards). Above a million unknowns, the automatic ordering is
/// METIS and indices have 64 bits. An empty system is OK. May throw std::bad_alloc; UMFPACK's own
/// failures are outcomes.
/// \param threads 2 or more: the two right-hand sides are solved at the same time; same result
Solution
solveWithUmfpack (const LinearSystem& system, Ordering ordering, int threads = 1);

} // namespace floater
} // namespace pcl
