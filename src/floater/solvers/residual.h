// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The residual of a solution.
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

namespace pcl::floater {
/// b - A u, computed from the matrix itself. An iterative solver may believe it to be less. Norms
/// are Euclidean, one for each coordinate.
struct Residual
{
  double largest = 0.0;             ///< largest entry of both, absolute; NaN if any entry is
  std::array<double, 2> norm{};     ///< |b - A u|
  std::array<double, 2> rhs{};      ///< |b|
  std::array<double, 2> rounding{}; ///< bound of its rounding error: 4 eps | |A| |u| + |b| |

  /// |b - A u| / |b|, or 0 if the residual is 0.
  /// \param side coordinate, 0 or 1
  double relative (std::size_t side) const;

  /// Whether the relative residual is at most the tolerance, or as small as double precision lets
  /// it be: storing u with 16 digits alone gives a large system a relative residual above 1e-15.
  bool isWithin (double tolerance, std::size_t side) const;
};

/// Measures the residual. O(entries).
/// \param uv per unknown
Residual
measureResidual (const LinearSystem& system, const std::vector<Eigen::Vector2d>& uv);

/// Records the residual of solution.uv. If it is not finite, the outcome becomes FAILED, with a
/// message and without uv.
void
recordResidual (const LinearSystem& system, Solution& solution);

} // namespace pcl::floater
