// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Removes triangles from a mesh that stays a manifold.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Removes triangles. If a point then has several fans of triangles, only the largest (the first of
/// equal ones) is kept, and the triangles of the others are removed as well, repeatedly. The mesh
/// stays an oriented manifold, and may become empty. O(n).
/// \param is_removed of each triangle: 1 to remove it
void
removeTriangles (TriangleMesh& mesh, std::vector<std::uint8_t> is_removed, const RunContext& run);

/// Removes components of fewer points. O(n).
/// \return number of components removed
std::size_t
removeSmallComponents (TriangleMesh& mesh, std::size_t fewest_points, const RunContext& run);

} // namespace pcl::floater
