// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Test whether a cloud was scanned along lines, and the planes of these lines.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/neighbor_table.h"
#include "points/points.h"
#include "view/patch_rays.h"

#include <vector>

namespace pcl::floater {
struct RowEvidence
{
  double share = 0.0; ///< share of points between their two nearest neighbours, on opposite sides
  Eigen::Vector3d across = Eigen::Vector3d::Zero (); ///< unit vector across the planes of the rows
  bool are_straight = true; ///< all rows have one direction, so their planes are undetermined
};

/// \param neighbors nearest first
/// \param count number of tested points, spread evenly over their order. O(count).
RowEvidence
findRows (const Points& points, const NeighborTable& neighbors, std::size_t count,
          const RunContext& run);

/// Patches of near points around points that are spread evenly over their order. Parallel rays to a
/// patch are near each other for any direction.
/// \param neighbors of each point
/// \param count     of patches
/// \param size      points of a patch; fewer if there are no more around
/// \return the points of each patch, sorted by distance to the first one
std::vector<RayPatch>
findPointPatches (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  std::size_t count, std::size_t size, const RunContext& run);

} // namespace pcl::floater
