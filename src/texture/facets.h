// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Facets: small, nearly plane discs of triangles.
#pragma once

#include "mesh/triangle_mesh.h"
#include "texture/chart_limits.h"

#include <vector>

namespace pcl::floater {
/// A partition of the triangles of a mesh.
struct MeshParts
{
  std::vector<Index> of_triangle; ///< numbered from 0 in the order of their first triangles
  Index count = 0;
};

/// Area vectors of all triangles: twice the area times the unit normal. O(n).
std::vector<Eigen::Vector3d>
areaVectors (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const RunContext& run);

/// Joins neighbouring triangles to facets: discs, at most as large as ChartLimits::most_in_facet
/// and flatter than ChartLimits::facet_deviation. Few triangles stay alone. O(n), one thread: 0.2
/// microseconds per triangle.
MeshParts
growFacets (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            const std::vector<Eigen::Vector3d>& area_vectors, const ChartLimits& limits,
            const RunContext& run);

} // namespace pcl::floater
