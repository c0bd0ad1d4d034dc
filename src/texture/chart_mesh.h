// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A chart as a mesh of its own, the shapes of its triangles, and their stretch.
#pragma once

#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Some triangles of a larger mesh, with their own vertex numbers.
struct MeshPiece
{
  TriangleMesh mesh;         ///< connected (TriangleMesh::connect), if it is a manifold
  std::vector<Index> points; ///< of the larger mesh, ascending: one for each vertex
  Positions positions;       ///< of the vertices
  std::vector<Index> loop;   ///< vertices of the boundary in order, the piece on the left, from the
                             ///< smallest one on; empty if the piece is not a disc
};

/// O(triangles log triangles).
/// \param triangles, positions of the larger mesh
/// \param piece its triangles
MeshPiece
cutOut (const std::vector<Triangle>& triangles, const std::vector<Index>& piece,
        const Positions& positions);

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

/// Sums over triangles for the stretch. The map goes from the plane to the surface, as in texture
/// mapping: where it enlarges, the texture is coarse.
class StretchSums
{
public:
  /// Adds a triangle in space and in the plane; ignored if it has no area in space.
  void add (const std::array<Vector3d, 3>& place, const std::array<Vector2d, 3>& uv);

  double planeArea () const { return plane_area_; }

  /// L2 stretch: root mean square over the surface of the singular values of the map, times the
  /// root of the ratio of the areas. 1 if all lengths have the same ratio, or without triangles;
  /// otherwise more; infinite if a triangle with an area in space has none in the plane.
  double mean () const;

  /// L2 stretch without the root of the ratio; 1 without triangles.
  double absolute () const { return area_ > 0.0 ? std::sqrt (squares_ / area_) : 1.0; }

  /// L-infinity stretch: largest singular value of any triangle, times the same root.
  double largest () const;

private:
  double squares_ = 0.0; // integral of the mean square of the two singular values
  double area_ = 0.0, plane_area_ = 0.0;
  double largest_ = 0.0; // singular value
};

/// Sums over a mesh.
/// \param corners of its triangles as indices of uv, parallel to triangles
StretchSums
stretchOf (const std::vector<Triangle>& triangles, const Positions& positions,
           const std::vector<Triangle>& corners, const std::vector<Vector2d>& uv);

/// The triangles that are not anti-clockwise in the plane, ascending. Exact.
/// \param triangles corners as indices of uv
std::vector<Index>
flippedTriangles (const std::vector<Triangle>& triangles, const std::vector<Vector2d>& uv);

} // namespace pcl::floater
