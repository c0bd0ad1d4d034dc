// SPDX-License-Identifier: GPL-3.0-or-later
// What every solver returns.
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// Solution of a LinearSystem and what it cost.
struct Solution
{
  enum class Outcome
  {
    OK,
    SINGULAR,
    NOT_CONVERGED,
    OUT_OF_MEMORY,
    UNAVAILABLE, ///< this build is without the solver's library
    FAILED
  };
  Outcome outcome = Outcome::FAILED;
  std::string message;             ///< why, unless OK
  std::vector<Eigen::Vector2d> uv; ///< per unknown; empty unless OK
  std::size_t nnz_factors = 0; ///< nnz (L + U), unit diagonal of L not counted twice; of incomplete
                               ///< factors too
  double residual = 0.0;       ///< max |b - A u|
  double relative_residual = 0.0;          ///< |b - A u| / |b| of the worse right-hand side
  std::array<std::size_t, 2> iterations{}; ///< of iterative solvers, for u and v
  double reciprocal_condition = 0.0;       ///< direct: min |U_kk| / max |U_kk|; 1 if empty
  std::size_t peak_bytes = 0;              ///< direct: memory of the factorization, as used
};

/// Reciprocal condition, with pivots on the diagonal, below which a system counts as singular. An
/// island of unknowns leaves a pivot of rounding errors, seldom exactly 0 (up to 3e-14 with 5000
/// unknowns); unknowns that hang on the loop by the smallest weights (see weights.h) stay above.
constexpr double SINGULAR_RECIPROCAL_CONDITION = 1e-12;

} // namespace floater
} // namespace pcl
