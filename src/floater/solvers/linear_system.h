// SPDX-License-Identifier: GPL-3.0-or-later
// The linear system of Floater's parameterization (TW 385, equation (1)).
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"

#include <Eigen/Core>

#include <vector>

namespace pcl
{
namespace floater
{
/// A u = b for both coordinates of the interior points, by rows.
struct LinearSystem
{
  std::vector<Index> point_of_unknown; ///< interior points that reach the loop, ascending
  std::vector<Index> unknown_of_point; ///< NONE for points of the loop and points left out
  std::vector<int> row_offsets;        ///< one more than unknowns
  std::vector<int> columns;            ///< ascending in each row
  std::vector<double> values;          ///< diagonal: sum of the row's weights, loop included
  std::vector<double> rhs_u, rhs_v;

  std::size_t unknowns () const { return point_of_unknown.size (); }
  std::size_t nonzeros () const { return values.size (); }
};

/// Assembles the system. A row's diagonal is the sum of its weights with those of loop points
/// included, so that row sums are exact and the solution is as good as the solver. O(entries); the
/// same for every number of threads.
/// \param neighbors    rows of points, distinct in each row and without the row's own point; a
///                     neighbour that is neither unknown nor on the loop is left out
/// \param weights      parallel to neighbors.ids, positive
/// \param loop         points of the loop in order
/// \param loop_uv      their parameters
/// \param reachable    per point, 1 if it takes part (see reachability.h)
LinearSystem
assembleSystem (const CsrLists& neighbors, const std::vector<double>& weights,
                const std::vector<Index>& loop, const std::vector<Eigen::Vector2d>& loop_uv,
                const std::vector<std::uint8_t>& reachable, const RunContext& run);

} // namespace floater
} // namespace pcl
