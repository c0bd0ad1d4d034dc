// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Figures that compare meshes over the same points.
#pragma once

#include "core/types.h"

#include <filesystem>
#include <vector>

namespace pcl
{
namespace floater
{
/// Edges as (smaller point, larger point), ascending, each once.
using Edges = std::vector<std::array<Index, 2>>;

Edges
edgesOf (const std::vector<Triangle>& triangles);

/// Edges of `a` that `b` has too.
std::size_t
commonEdges (const Edges& a, const Edges& b);

/// Triangles of the ground truth NAME.gt.ply beside NAME.pcd; empty if there is none.
/// \throw std::runtime_error if it is there but cannot be read or does not fit the cloud
std::vector<Triangle>
readGroundTruth (const std::filesystem::path& cloud, std::size_t points);

/// Triangles that face away from the ground truth at their corners, after the whole mesh has been
/// turned to the side on which they are fewer.
std::size_t
turnedTriangles (const std::vector<Triangle>& triangles, const std::vector<Triangle>& truth,
                 const std::vector<Eigen::Vector3d>& positions);

/// Distance of the two nearest of the points that are finite.
double
smallestDistance (const std::vector<Eigen::Vector2d>& points);

} // namespace floater
} // namespace pcl
