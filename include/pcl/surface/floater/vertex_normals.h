// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of the vertices of a mesh.
#pragma once

#include <pcl_floater/export.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl::floater {
/// Normals of the vertices of a triangle mesh: the mean of the normals of the triangles around each
/// one, weighted by their angles there (G. Thuermer, C. A. Wuethrich, Computing vertex normals from
/// polygonal facets, 1998). They do not depend on how a flat face is cut into triangles, on the
/// order of the triangles, or on the number of threads. They point to the front: the side from
/// which the corners are anti-clockwise. The mesh need not be a manifold. Takes 0.6 microseconds
/// per point and core, and 28 bytes per point beside the result.
/// \param positions of the points; read for corners only
/// \param triangles indices into `positions`; ignored if without area or with non-finite corners
/// \param threads 0 or less: one for each core
/// \return one for each position, of length 1 in float precision; (0, 0, 0) for points in no valid
///     triangle, and where the normals around a point cancel
/// \throws std::out_of_range if a triangle has a corner that is not in `positions`
/// \throws std::length_error if there are 1.4e9 triangles or more
/// \throws std::bad_alloc
PCL_FLOATER_EXPORT std::vector<Eigen::Vector3f>
vertexNormals (const std::vector<Eigen::Vector3d>& positions,
               const std::vector<std::array<std::uint32_t, 3>>& triangles, int threads = 0);

} // namespace pcl::floater
