// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Linear systems of triangulated grids, for the tests of solvers and orderings.
#pragma once

#include "floater/solvers/solver.h"
#include "floater/weights.h"
#include "triangulated_grid.h"

#include <numeric>
#include <utility>
#include <vector>

namespace pcl::floater {
/// The system of all interior points.
/// \param loop_uv parameters of the grid's loop
inline LinearSystem
gridSystem (const TriangulatedGrid& grid, Weighting weighting,
            const std::vector<Eigen::Vector2d>& loop_uv)
{
  return assembleSystem (grid.stars.neighbors, computeWeights (grid.stars, weighting, 1), grid.loop,
                         loop_uv, std::vector<std::uint8_t> (grid.positions.size (), 1));
}

/// The same with the loop in its place. Weights that reproduce linear functions then leave all
/// points in their places.
inline LinearSystem
gridSystem (const TriangulatedGrid& grid, Weighting weighting = Weighting::MEAN_VALUE)
{
  return gridSystem (grid, weighting, grid.loopInPlace ());
}

/// All entries of the matrix.
inline Eigen::MatrixXd
denseMatrix (const LinearSystem& system)
{
  const auto n = static_cast<Eigen::Index> (system.unknowns ());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero (n, n);
  for (std::size_t i = 0; i < system.unknowns (); ++i)
    system.visitRow (i, [&] (std::size_t j, double value) {
      dense (static_cast<Eigen::Index> (i), static_cast<Eigen::Index> (j)) = value;
    });
  return dense;
}

/// A random order of so many unknowns.
inline std::vector<int>
randomOrder (std::size_t count, std::uint64_t seed)
{
  std::vector<int> order (count);
  std::iota (order.begin (), order.end (), 0);
  RandomStream random (seed);
  for (std::size_t i = count; i > 1; --i)
    std::swap (order[i - 1], order[random.below (i)]);
  return order;
}

} // namespace pcl::floater
