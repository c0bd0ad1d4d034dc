// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The triangulation of the rays of an organized cloud, whose pixels tell most of it.
#pragma once

#include "core/run_context.h"
#include "mesh/triangle_mesh.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl::floater {
/// The Delaunay triangulation of rays that lie in rows and columns: the same triangles as those of
/// triangulateHull (), in another order. A cell is the square of four pixels next to each other.
/// Where all four have a point and their circles are empty, its triangles are known; only what is
/// left between such cells is triangulated by triangulateHull (). O(n), plus O(m log m) for m
/// points beside cells that miss a point.
/// \param places        where the rays meet the plane (see Rays::places)
/// \param cloud_index   of each point; distinct
/// \param lattice_width pixels of a row, at least 2: cloud index = row * lattice_width + column
/// \return nothing if the rays are not in the order of the pixels, or if too few cells are complete
/// for a gain
std::optional<TriangleMesh>
triangulateLattice (const std::vector<Eigen::Vector2d>& places,
                    const std::vector<Index>& cloud_index, std::size_t lattice_width,
                    const RunContext& run);

} // namespace pcl::floater
