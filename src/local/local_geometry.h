// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry around each point.
#pragma once

#include "local/stars.h"
#include "local/tangent_planes.h"
#include "points/points.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// What both methods know of the surface around each point.
struct LocalGeometry
{
  CsrLists neighbors;         ///< nearest first
  std::vector<float> spacing; ///< of the working positions: see localSpacing, or REACH_AS_SPACING
                              ///< of the reach of the star if that is more
  std::vector<float> own_spacing; ///< of the positions themselves if these are others; else empty
  Stars stars;                    ///< with the normals of the points

  /// Spacing on the mesh, whose vertices are the positions themselves.
  const std::vector<float>& meshSpacing () const
  {
    return own_spacing.empty () ? spacing : own_spacing;
  }
};

/// Tangent planes, spacing and stars by the working positions of the points. O(n k log k).
/// \param neighbors of each point, nearest first
/// \param known     kd-tree of the working positions; nullptr: one is built if it is needed
LocalGeometry
makeLocalGeometry (const Points& points, CsrLists neighbors, const StarSettings& settings,
                   const RunContext& run, const PlaneLimits& planes = {},
                   const KdTree* known = nullptr);

} // namespace floater
} // namespace pcl
