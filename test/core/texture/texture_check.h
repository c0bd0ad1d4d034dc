// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold of all texture coordinates, checked without any code of the library.
#pragma once

#include "core/types.h"

#include <pcl/surface/floater/texture_coordinates.h>

#include <string>
#include <vector>

namespace pcl::floater::samples {
/// Pairs of triangles in the plane whose insides have a point in common, found exactly.
/// \param corners per triangle, anti-clockwise
std::size_t
countOverlaps (const std::vector<std::array<Eigen::Vector2f, 3>>& corners);

/// All that is wrong with texture coordinates of a mesh, one line each; empty if nothing is:
/// sizes and indices, coordinates out of the square, charts that are no disc, triangles that are
/// flipped, overlaps, charts nearer to each other than the gutter, seams, figures.
/// \param with_distances of charts; takes a second for 2000 vertices on their boundaries
std::string
flawsOfTexture (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Triangle>& triangles, const TextureCoordinates& texture,
                bool with_distances = false);

} // namespace pcl::floater::samples
