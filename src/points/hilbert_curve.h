// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Order along the Hilbert curve.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// Positions, and their cloud indices.
struct CurveOrder
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<Index> cloud_index;
};

/// Sorts positions along a Hilbert curve through the box from -1/2 to 1/2, then along a curve
/// within each of its cells, then by coordinates: beside a piece many times as large, a whole
/// object may lie in a few cells. Of equal positions, the smallest cloud index is first. The order
/// of distinct positions does not depend on the order of the input.
///
/// First distributes the positions to buckets along the curve, chosen by a sample; then sorts each
/// bucket. All arrays are read and written sequentially, in up to 1024 buckets. In memory are 9 MB,
/// and 40 bytes for each point of one bucket per thread; the rest may be mapped files. O(n log n).
/// \param positions   non-finite ones are left out
/// \param cloud_index of each position; distinct
/// \param centre, scale (position - centre) / scale is sorted, and lies in the box
CurveOrder
sortAlongCurve (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Index>& cloud_index, const Eigen::Vector3d& centre, double scale,
                const RunContext& run);

} // namespace pcl::floater
