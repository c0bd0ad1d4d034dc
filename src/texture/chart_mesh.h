// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A chart as a mesh of its own, what is around its points, and the shapes of its triangles.
#pragma once

#include "mesh/triangle_mesh.h"

#include <array>
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

/// What is around each point of a mesh.
struct MeshRings
{
  explicit MeshRings (const TriangleMesh& mesh);

  CsrLists leaving;          ///< edges that leave it, as 3 triangle + side
  std::vector<Index> before; ///< neighbour along the boundary, NONE if inside
  std::vector<Index> after;  ///< the other one
  CsrLists neighbors;        ///< in the order of these edges, then `before`

  /// The mean value of the neighbours of a vertex; at the boundary, of those along it.
  template <typename Vector>
  Vector meanAround (const std::vector<Vector>& values, Index p) const
  {
    if (before[p] != NONE)
      return 0.5 * (values[before[p]] + values[after[p]]);
    Vector sum = Vector::Zero ();
    for (const Index q : neighbors.row (p))
      sum += values[q];
    return sum / static_cast<double> (neighbors.row (p).size ());
  }
};

/// A triangle in the plane, anti-clockwise, with its longest edge on the first axis. Lengths are
/// relative to that edge.
struct FlatTriangle
{
  std::array<Eigen::Vector2d, 3> corners;
  double longest; ///< of its edges in space
};

/// \param least_height of the triangle; thinner ones get it
FlatTriangle
layFlat (const std::array<Eigen::Vector3d, 3>& place, double least_height);

/// A triangle laid flat: map from the edges at its first corner to the unit vectors.
struct RestShape
{
  Eigen::Matrix2d to_unit; ///< inverse of the matrix whose columns are these two edges
  double area;
};

/// Minimum height over longest edge; thinner triangles are treated as if they had it. They are
/// noise of the sampling, and a layout with their shape would not survive rounding: at a length of
/// 1/1000 of the texture they have 100 steps of single precision.
constexpr double LEAST_HEIGHT = 0.01;

/// The shapes of all triangles of a chart, scaled to a total area of 1. Edges without length count
/// as LEAST_HEIGHT of the longest edge of the chart.
struct RestShapes
{
  std::vector<RestShape> shapes; ///< parallel to the triangles
  double area = 0.0;             ///< of all together before scaling, in the unit of the positions
};

/// O(triangles).
RestShapes
makeRestShapes (const MeshPiece& chart);

} // namespace pcl::floater
