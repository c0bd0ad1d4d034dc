// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetric permutations of the system (TW 385, section 4.2 and Figure 4).
#pragma once

#include "floater/solvers/linear_system.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// The unknown that comes i-th, for every i. Orderings work on the pattern of A + A^T.
/// AMD and METIS are those of UMFPACK, REVERSE_CUTHILL_MCKEE is that of Boost.Graph.
/// \param ordering AMD, METIS, REVERSE_CUTHILL_MCKEE or NATURAL
/// \throws std::invalid_argument for another ordering, std::bad_alloc, std::runtime_error if
///         UMFPACK fails
std::vector<int>
orderUnknowns (const LinearSystem& system, Ordering ordering);

/// Reverse Cuthill-McKee alone, each component from a vertex at its rim. O(entries log entries).
std::vector<int>
reverseCuthillMckee (const LinearSystem& system);

/// Rows and columns of the system in that order: row i is row order[i], columns ascending.
LinearSystem
permuteSystem (const LinearSystem& system, const std::vector<int>& order);

} // namespace floater
} // namespace pcl
