// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Distance scale of the sampling.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/rows.h"

#include <vector>

namespace pcl::floater {
/// Local spacing: the mean distance of each point to its (up to) 6 nearest neighbours; on a regular
/// triangulation that is the length of an edge. O(n).
/// \param neighbors nearest first
std::vector<float>
localSpacing (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const RunContext& run);

/// localSpacing () of the points in `rows`; 0 for other points.
/// \param neighbors of the points in `rows`
std::vector<float>
localSpacing (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const Rows& rows, const RunContext& run);

} // namespace pcl::floater
