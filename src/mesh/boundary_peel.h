// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Removal of triangles from the boundary of a mesh, one by one.
#pragma once

#include "mesh/triangle_mesh.h"

#include <utility>
#include <vector>

namespace pcl::floater {
/// Marks triangles to be removed from the boundary; the mesh itself stays unchanged. A triangle may
/// be removed if it has one boundary edge, and its other corner is inside. So every point keeps a
/// triangle, the mesh stays a manifold, and the numbers of components and boundary loops and the
/// genus stay. In a submesh, edges between partial points are not boundary edges; partial points
/// count as boundary.
/// at the boundary, and partial points count as if they were.
class BoundaryPeel
{
public:
  /// O(n).
  /// \param points number of points of the mesh
  BoundaryPeel (const TriangleMesh& mesh, std::size_t points, const RunContext& run)
      : mesh_ (mesh), is_taken_ (mesh.triangles.size (), 0), is_at_boundary_ (points, 0)
  {
    ProgressLoop progress (run);
    for (Index t = 0; t < mesh.triangles.size (); ++t) {
      progress.next ();
      for (std::uint8_t side = 0; side < 3; ++side)
        if (mesh.neighbors[t][side] == NONE && !isEndOfPart ({t, side})) {
          edges_.push_back ({t, side});
          is_at_boundary_[mesh.from (edges_.back ())] = 1;
          is_at_boundary_[mesh.to (edges_.back ())] = 1;
        }
    }
    for (Index p = 0; p < mesh.is_partial.size (); ++p)
      if (mesh.is_partial[p] != 0)
        is_at_boundary_[p] = 1;
  }

  /// The boundary edges of the mesh, in the order of its triangles.
  const std::vector<MeshEdge>& edges () const { return edges_; }

  bool isTaken (Index triangle) const { return is_taken_[triangle] != 0; }

  /// Whether no triangle is left across an edge.
  bool isBoundary (MeshEdge e) const
  {
    const Index other = mesh_.neighbors[e.triangle][e.side];
    return other == NONE ? !isEndOfPart (e) : isTaken (other);
  }

  /// \param e a boundary edge of the remaining mesh
  bool mayTake (MeshEdge e) const
  {
    return !isTaken (e.triangle) && is_at_boundary_[mesh_.corner (e)] == 0;
  }

  /// Removes the triangle of an edge for which mayTake () holds.
  void take (MeshEdge e) { is_taken_[e.triangle] = is_at_boundary_[mesh_.corner (e)] = 1; }

  /// Restores the triangle that was removed last.
  void putBack (MeshEdge e) { is_taken_[e.triangle] = is_at_boundary_[mesh_.corner (e)] = 0; }

  /// Of each triangle: 1 if it is removed. For removeTriangles.
  std::vector<std::uint8_t> takenTriangles () && { return std::move (is_taken_); }

private:
  bool isEndOfPart (MeshEdge e) const
  {
    return mesh_.isPartial (mesh_.from (e)) && mesh_.isPartial (mesh_.to (e));
  }

  const TriangleMesh& mesh_;
  std::vector<MeshEdge> edges_;
  std::vector<std::uint8_t> is_taken_;       // per triangle
  std::vector<std::uint8_t> is_at_boundary_; // per point
};

} // namespace pcl::floater
