// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle mesh with neighbours, for local changes.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// An edge of a triangle: the one opposite to its corner `side`.
struct MeshEdge
{
  Index triangle;
  std::uint8_t side;
};

/// What a mesh was before it was changed: entries that TriangleMesh writes while it is recorded.
class MeshJournal
{
public:
  /// Appends the triangles that were changed; some come more than once.
  void appendTriangles (std::vector<Index>& list) const
  {
    for (const Entry& entry : entries_)
      if (entry.triangle != NONE)
        list.push_back (entry.triangle);
  }

private:
  friend struct TriangleMesh;
  struct Entry
  {
    Index triangle; ///< NONE: the entry is of a point
    Triangle corners;
    std::array<Index, 3> neighbors; ///< of a point: (point, its triangle, -)
  };
  std::vector<Entry> entries_;
  bool is_recording_ = false;
};

/// Oriented manifold with boundary. Triangle t has corners a, b, c anti-clockwise; its neighbour i
/// is across the edge opposite to corner i, NONE at the boundary. Every vertex has a single fan.
struct TriangleMesh
{
  std::vector<Triangle> triangles;
  std::vector<std::array<Index, 3>> neighbors;
  std::vector<Index> triangle_of; ///< per point: one of its triangles, NONE if it is not a vertex
  MeshJournal journal;            ///< of flip, split and replaceFan, while it is recorded

  static std::uint8_t next (std::uint8_t side)
  {
    return static_cast<std::uint8_t> (side == 2 ? 0 : side + 1);
  }
  static std::uint8_t previous (std::uint8_t side)
  {
    return static_cast<std::uint8_t> (side == 0 ? 2 : side - 1);
  }

  Index corner (MeshEdge e) const { return triangles[e.triangle][e.side]; }
  Index from (MeshEdge e) const { return triangles[e.triangle][next (e.side)]; }
  Index to (MeshEdge e) const { return triangles[e.triangle][previous (e.side)]; }

  /// Corner of triangle t that is point p.
  std::uint8_t sideOf (Index t, Index p) const
  {
    return static_cast<std::uint8_t> (triangles[t][0] == p ? 0 : triangles[t][1] == p ? 1 : 2);
  }

  /// The same edge seen from the neighbour; triangle NONE at the boundary.
  MeshEdge mate (MeshEdge e) const
  {
    const Index other = neighbors[e.triangle][e.side];
    if (other == NONE)
      return {NONE, 0};
    return {other, next (sideOf (other, from (e)))};
  }

  /// Triangles around p, anti-clockwise; at the boundary from one boundary edge to the other.
  /// Empty if p is no vertex.
  void fan (Index p, std::vector<Index>& fan_triangles) const;

  /// True if an edge joins p and q, which must be vertices.
  bool hasEdge (Index p, Index q) const;

  /// Replaces the edge by the other diagonal of its two triangles. It must not be a boundary edge
  /// and the other diagonal must not be an edge yet. Afterwards the edge's triangle has corners
  /// (corner, from, opposite) and the neighbour (opposite, to, corner).
  void flip (MeshEdge e);

  /// Splits triangle t in three at point p, which must not be a vertex.
  void split (Index t, Index p);

  /// The same; the second and third triangle go to slots u and v, which must not be in use.
  void split (Index t, Index p, Index u, Index v);

  /// Replaces the closed fan around p by triangles of the polygon around it, two fewer, which join
  /// no points that an edge joins already. The last two slots of the fan are then not in use.
  void replaceFan (Index p, const std::vector<Index>& fan_triangles,
                   const std::vector<Triangle>& filling);

  /// Records changes from here on, in an empty journal. \param is_on false: no longer
  void recordChanges (bool is_on = true);

  /// The state of the mesh, to come back to by undo ().
  std::size_t mark () const { return journal.entries_.size (); }

  /// Undoes all changes that were recorded after a mark, last first.
  void undo (std::size_t mark);

  /// Sets neighbours and triangle_of from the triangles. O(n).
  /// \return false if the triangles are no oriented manifold (the mesh is then unusable)
  bool connect (std::size_t points, const RunContext& run);

private:
  // Sets the neighbours across the edges that leave p. False if one leaves it twice.
  bool connectFrom (Index p, const std::vector<Index>& offsets, const std::vector<Index>& leaving);
  void link (Index t, std::uint8_t side, MeshEdge other);
  void set (Index t, const Triangle& corners);
  void setTriangleOf (Index p, Index t);
  void note (Index t);
};

/// Boundary loops, each with the surface on its left, in order of their smallest point, starting at
/// it.
std::vector<std::vector<Index>>
boundaryLoops (const TriangleMesh& mesh);

/// Components of a mesh: triangles that are connected by edges.
struct MeshComponents
{
  std::vector<Index> of_triangle; ///< numbered from 0 in the order of their first triangles
  Index count = 0;
};

/// O(n).
MeshComponents
findComponents (const TriangleMesh& mesh);

/// Vertices of each component. O(n).
std::vector<std::size_t>
countPoints (const TriangleMesh& mesh, const MeshComponents& components);

} // namespace floater
} // namespace pcl
