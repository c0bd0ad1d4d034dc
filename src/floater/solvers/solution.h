// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The result of a solver.
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace pcl::floater {
/// The solution of a LinearSystem, and what it cost.
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
  std::string message;             ///< reason, unless OK
  std::vector<Eigen::Vector2d> uv; ///< per unknown; empty unless OK
  std::size_t nnz_factors = 0;     ///< entries of L and U, also of incomplete factors; the unit
                                   ///< diagonal of L is not counted
  double residual = 0.0;           ///< max |b - A u|
  double relative_residual = 0.0;  ///< |b - A u| / |b| of the worse right-hand side
  std::array<std::size_t, 2> iterations{}; ///< iterative solvers: for u and for v
  double reciprocal_condition = 0.0; ///< direct solvers: min |U_kk| / max |U_kk|; 1 if there is
                                     ///< no unknown
  std::size_t peak_bytes = 0; ///< direct solvers: largest memory of the factorization, if known
};

/// Pivots on the diagonal: a system counts as singular if its reciprocal condition is below this.
/// Floating unknowns leave a pivot of rounding errors that is seldom exactly 0 (up to 3e-14 with
/// 5000 unknowns). Unknowns that depend on the loop by the smallest of weights (SMALLEST_WEIGHT)
/// stay above.
constexpr double SINGULAR_RECIPROCAL_CONDITION = 1e-12;

} // namespace pcl::floater
