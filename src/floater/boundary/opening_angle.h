// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary points by the largest angle (TW 385, section 3.1).
#pragma once

#include "local/stars.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Points whose widest sector without any of the k neighbours, projected on the tangent plane, is
/// wider than `opening_angle` (radians), ascending. O(n k log k).
std::vector<Index>
openingAnglePoints (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                    const std::vector<Eigen::Vector3f>& normals, double opening_angle,
                    const RunContext& run);

} // namespace floater
} // namespace pcl
