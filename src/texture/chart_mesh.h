// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One chart as a separate mesh.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Some triangles of a larger mesh, with their own vertex numbers.
struct ChartMesh
{
  TriangleMesh mesh;                      ///< connected (TriangleMesh::connect), if it is a
                                          ///< manifold
  std::vector<Index> points;              ///< of the larger mesh, ascending: one for each vertex
  std::vector<Eigen::Vector3d> positions; ///< of the vertices
  std::vector<Index> loop; ///< vertices of the boundary in order, the chart on the left, from the
                           ///< smallest one on; empty if the chart is not a disc
};

/// Makes the mesh of a chart. O(triangles log triangles).
/// \param triangles of the larger mesh
/// \param positions of the points of the larger mesh
ChartMesh
makeChartMesh (const std::vector<Triangle>& triangles, const std::vector<Index>& chart,
               const std::vector<Eigen::Vector3d>& positions);

} // namespace pcl::floater
