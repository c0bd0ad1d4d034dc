// SPDX-License-Identifier: GPL-3.0-or-later
// Unknowns that nothing ties to the boundary.
#pragma once

#include "floater/solvers/linear_system.h"

namespace pcl
{
namespace floater
{
/// How many unknowns do not lead, from row to column, to a row that the boundary has a part in: one
/// whose diagonal exceeds the other entries. With weights that are positive the system is singular
/// if and only if there are any. An iterative solver would not notice: it stops at one of the many
/// solutions. For systems whose diagonal is nowhere less than the row's other entries. O(entries).
std::size_t
countFloatingUnknowns (const LinearSystem& system);

} // namespace floater
} // namespace pcl
