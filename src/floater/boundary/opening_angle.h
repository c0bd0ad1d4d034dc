// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary points by their opening angle (TW 385, section 3.1).
#pragma once

#include "core/run_context.h"
#include "local/stars.h"

#include <vector>

namespace pcl::floater {
/// Points whose widest sector without a neighbour exceeds the opening angle, ascending. Neighbours
/// are projected on the tangent plane of the point. O(n k log k).
/// \param positions     per point
/// \param neighbors     k nearest neighbours of each point
/// \param normals       per point, unit length, of any sign
/// \param opening_angle in radians
std::vector<Index>
openingAnglePoints (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                    const std::vector<Eigen::Vector3f>& normals, double opening_angle,
                    const RunContext& run);

} // namespace pcl::floater
