// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/residual.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
double
Residual::relative (std::size_t side) const
{
  return norm[side] == 0.0 ? 0.0 : norm[side] / rhs[side];
}

bool
Residual::isWithin (double tolerance, std::size_t side) const
{
  return norm[side] <= std::max (tolerance * rhs[side], rounding[side]);
}

Residual
measureResidual (const LinearSystem& system, const std::vector<Eigen::Vector2d>& uv)
{
  constexpr double ROUNDING = 4.0 * std::numeric_limits<double>::epsilon ();
  Residual residual;
  Eigen::Array2d sqr_norm = Eigen::Array2d::Zero (), sqr_rhs = sqr_norm, sqr_magnitude = sqr_norm;
  for (std::size_t i = 0; i < system.unknowns (); ++i) {
    const Eigen::Array2d rhs (system.rhs_u[i], system.rhs_v[i]);
    Eigen::Array2d rest = rhs, magnitude = rhs.abs ();
    const auto last = static_cast<std::size_t> (system.row_offsets[i + 1]);
    for (auto entry = static_cast<std::size_t> (system.row_offsets[i]); entry < last; ++entry) {
      const Eigen::Array2d term =
          system.values[entry] * uv[static_cast<std::size_t> (system.columns[entry])].array ();
      rest -= term;
      magnitude += term.abs ();
    }
    const double of_row = rest.abs ().maxCoeff<Eigen::PropagateNaN> ();
    if (!(of_row <= residual.largest)) // true for NaN, too, which must not be replaced afterwards
      residual.largest = std::isnan (residual.largest) ? residual.largest : of_row;
    sqr_norm += rest.square ();
    sqr_rhs += rhs.square ();
    sqr_magnitude += magnitude.square ();
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const auto at = static_cast<Eigen::Index> (side);
    residual.norm[side] = std::sqrt (sqr_norm[at]);
    residual.rhs[side] = std::sqrt (sqr_rhs[at]);
    residual.rounding[side] = ROUNDING * std::sqrt (sqr_magnitude[at]);
  }
  return residual;
}

void
recordResidual (const LinearSystem& system, Solution& solution)
{
  const Residual residual = measureResidual (system, solution.uv);
  solution.residual = residual.largest;
  solution.relative_residual = std::max (residual.relative (0), residual.relative (1));
  if (std::isfinite (residual.largest))
    return;
  solution.outcome = Solution::Outcome::FAILED;
  solution.message = "the solution is not finite";
  solution.uv.clear ();
}

} // namespace pcl::floater
