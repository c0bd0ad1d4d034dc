// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Floating unknowns: unknowns that are not tied to the boundary.
#pragma once

#include "floater/solvers/linear_system.h"
#include "floater/solvers/solution.h"

namespace pcl::floater {
/// Counts the unknowns from which no path, from row to column, leads to a row in which the boundary
/// takes part: one whose diagonal exceeds the sum of its other entries. With positive weights the
/// system is singular if and only if there are such unknowns. An iterative solver would not notice;
/// it stops at one of the many solutions. O(entries).
/// \param system no diagonal is less than the sum of the row's other entries
std::size_t
countFloatingUnknowns (const LinearSystem& system);

/// Makes the outcome SINGULAR, with a message, if there are floating unknowns.
/// \return true if there are any
bool
refuseFloatingUnknowns (const LinearSystem& system, Solution& solution);

} // namespace pcl::floater
