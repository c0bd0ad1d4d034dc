// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetric permutations of the linear system (TW 385, section 4.2 and Figure 4).
#pragma once

#include "floater/solvers/linear_system.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl::floater {
/// An order of the unknowns, for a factorization with its pivots on the diagonal: entry i is the
/// unknown that comes i-th. It is made from the pattern of A + A^T alone. AMD is SuiteSparse's, and
/// METIS is called through CHOLMOD. Both orders follow the elimination tree, so that the systems
/// can be factorized as they come.
/// \param ordering AMD, METIS, REVERSE_CUTHILL_MCKEE or NATURAL
/// \throws std::invalid_argument for any other ordering; std::bad_alloc; std::runtime_error if the
///         library fails for another reason, which a valid pattern gives it no cause for
std::vector<int>
orderUnknowns (const LinearSystem& system, Ordering ordering);

/// The reverse Cuthill-McKee order, which keeps the bandwidth small, by Boost.Graph. Each component
/// begins at a vertex that is nearly as far as possible from another. O(entries log entries).
std::vector<int>
reverseCuthillMckee (const LinearSystem& system);

/// The system with its rows and columns in another order: row i is row order[i] of the original,
/// and columns are ascending again. O(entries log (row length)).
LinearSystem
permuteSystem (const LinearSystem& system, const std::vector<int>& order);

} // namespace pcl::floater
