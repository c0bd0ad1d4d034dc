// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points in the order of a space-filling curve, also where they do not fit into memory.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// Positions, and where each comes from.
struct CurveOrder
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<Index> cloud_index;
};

/// Sorts positions along a Hilbert curve through the box from -1/2 to 1/2, then along a curve
/// within each of its cells, then by coordinates: next to a part that is many times as large, a
/// whole object may lie in a few cells. Of equal positions, the smallest cloud index is first. So
/// the order does not depend on that of the input, but for positions that are equal.
///
/// Positions go to parts of the curve first, by a sample of them, and each part is sorted alone. So
/// all arrays are read and written from one end to the other, at the ends of up to 1024 parts: all
/// that has to be in memory are 9 MB, and 40 bytes for each point of a part, a part for each
/// thread. The others may lie in mapped files. O(n log n).
/// \param positions   any; those that are not finite are left out
/// \param cloud_index of each position; distinct
/// \param centre, scale what is sorted is (position - centre) / scale, in the box
CurveOrder
sortAlongCurve (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Index>& cloud_index, const Eigen::Vector3d& centre, double scale,
                const RunContext& run);

} // namespace pcl::floater
