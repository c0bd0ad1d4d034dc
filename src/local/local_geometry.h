// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry around each point.
#pragma once

#include "local/stars.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// What both methods know of the surface around each point.
struct LocalGeometry
{
  CsrLists neighbors;         ///< nearest first
  std::vector<float> spacing; ///< see localSpacing
  Stars stars;                ///< with the normals of the points
};

/// Tangent planes, spacing and stars by the working positions of the points. O(n k log k).
/// \param neighbors of each point, nearest first
LocalGeometry
makeLocalGeometry (const std::vector<Eigen::Vector3d>& positions, CsrLists neighbors,
                   const StarSettings& settings, const RunContext& run);

} // namespace floater
} // namespace pcl
