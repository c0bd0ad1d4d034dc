// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a cloud was scanned along lines, and in which planes these lie.
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
  double share =
      0.0; ///< of points between their two nearest neighbors, which lie to opposite sides
  Eigen::Vector3d across = Eigen::Vector3d::Zero (); ///< unit vector across the planes of the rows
  bool are_straight = true; ///< all rows run along one direction, so that they do not tell planes
};

/// \param neighbors nearest first
/// \param count number of points that are looked at, spread evenly over their order. O(count).
RowEvidence
findRows (const Points& points, const NeighborTable& neighbors, std::size_t count,
          const RunContext& run);

/// Patches of points that are near each other in space, around points that are spread evenly over
/// their order. So of parallel rays of whatever direction, those to a patch are near each other.
///
/// \param neighbors of each point
/// \param count     of patches
/// \param size      points of a patch; fewer if there are no more around
///
/// \return the points of each patch, the nearest to the first one first
std::vector<RayPatch>
findPointPatches (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  std::size_t count, std::size_t size, const RunContext& run);

} // namespace pcl::floater
