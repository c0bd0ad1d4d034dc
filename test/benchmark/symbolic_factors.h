// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where an order of the unknowns makes the factors have their nonzeros.
#pragma once

#include "floater/solvers/linear_system.h"

#include <functional>
#include <vector>

namespace pcl
{
namespace floater
{
/// Walks over the entries of the factors that the pattern of A + A^T has in this order, with no
/// pivoting off the diagonal and no cancellation. O(nnz (L)), no memory for the factors.
/// \param order unknown that comes i-th, for every i
/// \param visit called with row > column of each entry of L below the diagonal; may be empty
/// \return nnz (L + U), of which the other half mirrors that of L
std::size_t
symbolicFactors (const LinearSystem& system, const std::vector<int>& order,
                 const std::function<void (Index, Index)>& visit);

} // namespace floater
} // namespace pcl
