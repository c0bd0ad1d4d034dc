// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Spacing of the points on a mesh.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Spacing of each point on a mesh: the median length of its edges. For points without edges, the
/// median of all others. O(n).
std::vector<float>
spacingOfMesh (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const RunContext& run);

} // namespace pcl::floater
