// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How well the stars of neighbours agree.
#pragma once

#include "core/run_context.h"
#include "local/stars.h"

#include <vector>

namespace pcl::floater {
/// True if the star of p has a triangle with q and r, in either order. O(neighbours in the star).
bool
hasTriangle (const Stars& stars, Index p, Index q, Index r);

/// Share of the neighbours in each point's star that have the point in theirs; 0 without
/// neighbours. It is 1 for the Delaunay triangulation of a smooth, densely sampled surface, also on
/// ambiguous lattices. O(entries of the stars).
std::vector<float>
starAgreement (const Stars& stars, const RunContext& run);

} // namespace pcl::floater
