// SPDX-License-Identifier: GPL-3.0-or-later
// How well a solution solves its system, measured.
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

namespace pcl
{
namespace floater
{
/// b - A u, computed from the matrix itself: not what an iterative solver believes it to be.
struct Residual
{
  double largest = 0.0;         ///< max |b - A u| over rows and both right-hand sides; NaN if any
  std::array<double, 2> norm{}; ///< |b - A u|
  std::array<double, 2> rhs{};  ///< |b|
  std::array<double, 2> rounding{}; ///< what rounding makes of it: 4 eps | |A| |u| + |b| |

  /// |b - A u| / |b|, or 0 if both are.
  double relative (std::size_t side) const;

  /// At most the tolerance, or as small as double precision lets a residual be. The solution of a
  /// large system cannot have a relative residual of 1e-15: storing u to 16 digits makes more.
  bool isWithin (double tolerance, std::size_t side) const;
};

/// O(entries).
Residual
measureResidual (const LinearSystem& system, const std::vector<Eigen::Vector2d>& uv);

/// Records the residual of solution.uv; turns the outcome to FAILED if it is not finite.
void
recordResidual (const LinearSystem& system, Solution& solution);

} // namespace floater
} // namespace pcl
