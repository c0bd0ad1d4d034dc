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
/// polygonal facets, 1998). So it does not matter how a flat face is cut into triangles. They point
/// to where the triangles face: to the side from which their corners are anti-clockwise.
///
/// They do not depend on the order of the triangles, nor on the number of threads. The mesh may be
/// any, also one that is no manifold.
/// \param positions of the points that the triangles name; those of other points are not read
/// \param triangles indices into `positions`. One without an area, or with corners that are not
/// finite, counts for nothing
/// \param threads 0 or less: one for each core
/// \return one for each position, of length 1 in the precision of a float; (0, 0, 0) for points in
/// no triangle that counts, and where the normals around a point cancel each other
/// \throws std::out_of_range if a triangle names a point that is not in `positions`,
/// std::length_error if there are 1.4e9 triangles or more, std::bad_alloc. Takes 0.6 microseconds
/// per point and core, and 28 bytes per point beside the result
PCL_FLOATER_EXPORT std::vector<Eigen::Vector3f>
vertexNormals (const std::vector<Eigen::Vector3d>& positions,
               const std::vector<std::array<std::uint32_t, 3>>& triangles, int threads = 0);

} // namespace pcl::floater
