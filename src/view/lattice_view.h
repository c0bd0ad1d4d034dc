// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fast triangulation of the rays of an organized cloud.
#pragma once

#include "core/run_context.h"
#include "mesh/triangle_mesh.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl::floater {
/// The Delaunay triangulation of rays in rows and columns: the triangles of triangulateHull (), in
/// another order. A cell is a square of four adjacent pixels. If all four have a point and its
/// circles are empty, its triangles are known; only the space between such cells is triangulated by
/// triangulateHull (). O(n), plus O(m log m) for m points beside incomplete cells.
/// \param places        projected rays (see Rays::places)
/// \param cloud_index   of each point; distinct
/// \param lattice_width pixels of a row, at least 2: cloud index = row * lattice_width + column
/// \return nothing if the rays are not in the order of the pixels, or if too few cells are complete
///     for a gain
std::optional<TriangleMesh>
triangulateLattice (const std::vector<Eigen::Vector2d>& places,
                    const std::vector<Index>& cloud_index, std::size_t lattice_width,
                    const RunContext& run);

} // namespace pcl::floater
