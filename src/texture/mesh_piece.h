// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A part of a mesh as a separate mesh, such as a disc that is laid out alone.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Some triangles of a larger mesh, with their own vertex numbers.
struct MeshPiece
{
  TriangleMesh mesh;         ///< connected (TriangleMesh::connect), if it is a manifold
  std::vector<Index> points; ///< of the larger mesh, ascending: one for each vertex
  std::vector<Eigen::Vector3d> positions; ///< of the vertices
  std::vector<Index> loop; ///< vertices of the boundary in order, the piece on the left, from the
                           ///< smallest one on; empty if the piece is not a disc
};

/// O(triangles log triangles).
/// \param triangles of the larger mesh
/// \param piece     those of the piece
/// \param positions of the points of the larger mesh
MeshPiece
cutOut (const std::vector<Triangle>& triangles, const std::vector<Index>& piece,
        const std::vector<Eigen::Vector3d>& positions);

} // namespace pcl::floater
