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
  std::string message;              ///< why, unless OK
  std::vector<Eigen::Vector2d> uv;  ///< per unknown
  std::size_t nnz_factors = 0;      ///< nnz (L + U), unit diagonal of L not counted twice
  double residual = 0.0;            ///< max |b - A u|
  double reciprocal_condition = 0.0;
  std::size_t peak_bytes = 0; ///< of symbolic and numeric factorization, as used
};

/// One factorization, two right-hand sides. UMFPACK takes columns, so the rows are passed as the
/// transpose and solved with UMFPACK_At. Symmetric strategy, no scaling, no refinement, one BLAS
/// thread (restored afterwards); 64-bit indices from a million unknowns.
Solution
solveWithUmfpack (const LinearSystem& system, Ordering ordering);

} // namespace floater
} // namespace pcl
