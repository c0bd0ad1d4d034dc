// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters of boundary points (TW 385, section 3.2).
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// Clusters by region growing, each from the densest untaken point.
/// O(n log n) for n points along curves.
/// \param positions       per point
/// \param boundary_points ascending
/// \param tolerance       largest growing distance and radius in which density is counted, in the
///                        unit of the positions (xi D in TW 385)
/// \param k               nearest boundary points that are appended at a time
/// \return disjoint clusters of points, ascending in each; the largest cluster first, of equally
///         large ones that with the smallest point
std::vector<std::vector<Index>>
clusterBoundaryPoints (const std::vector<Eigen::Vector3d>& positions,
                       const std::vector<Index>& boundary_points, double tolerance, int k,
                       const RunContext& run);

} // namespace pcl::floater
