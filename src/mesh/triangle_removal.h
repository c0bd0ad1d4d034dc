// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Takes triangles out of a mesh so that it stays a manifold.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Takes triangles out. Where that leaves a point with several fans of triangles, only the largest
/// fan stays, and of equal ones the first; triangles of the others are taken out as well, until no
/// point has several fans. The mesh stays an oriented manifold, and may become empty. O(n).
/// \param is_removed of each triangle: 1 for those to take out
void
removeTriangles (TriangleMesh& mesh, std::vector<std::uint8_t> is_removed, const RunContext& run);

/// Takes out components of fewer points. O(n).
/// \return how many
std::size_t
removeSmallComponents (TriangleMesh& mesh, std::size_t fewest_points, const RunContext& run);

} // namespace pcl::floater
