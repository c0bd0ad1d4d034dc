// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle mesh with neighbours, which can be changed locally.
#pragma once

#include "core/csr_lists.h"
#include "core/geometry.h"
#include "core/run_context.h"

namespace pcl::floater {
/// An edge of a triangle, the one opposite to its corner `side` (0 to 2).
struct MeshEdge
{
  Index triangle;
  std::uint8_t side;
};

inline Vector3d
areaVectorOf (const Triangle& t, const Positions& positions)
{
  return areaVector (positions[t[0]], positions[t[1]], positions[t[2]]);
}

inline Vector3d
middleOf (const Triangle& t, const Positions& positions)
{
  return (positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3.0;
}

inline bool
isCorner (const Triangle& t, Index p)
{
  return t[0] == p || t[1] == p || t[2] == p;
}

/// Whether a condition holds for a corner of a triangle.
template <typename IsMet>
bool
anyCorner (const Triangle& t, IsMet&& is_met)
{
  return is_met (t[0]) || is_met (t[1]) || is_met (t[2]);
}

/// Oriented manifold with boundary. The corners of a triangle are anti-clockwise seen from the
/// front; its neighbour i is across the edge opposite to corner i, NONE at the boundary. The
/// triangles around a vertex are one fan. Changes by flip, split and replaceFan can be undone.
struct TriangleMesh
{
  std::vector<Triangle> triangles;
  std::vector<std::array<Index, 3>> neighbors;
  std::vector<Index> triangle_of; ///< per point: one of its triangles, NONE if it is not a vertex

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

  /// Corner of triangle t that is point p, which must be one.
  std::uint8_t sideOf (Index t, Index p) const
  {
    return static_cast<std::uint8_t> (triangles[t][0] == p ? 0 : triangles[t][1] == p ? 1 : 2);
  }

  /// The edge from the side of the neighbour; triangle NONE at the boundary.
  MeshEdge mate (MeshEdge e) const
  {
    const Index other = neighbors[e.triangle][e.side];
    if (other == NONE)
      return {NONE, 0};
    return {other, next (sideOf (other, from (e)))};
  }

  /// Sets `fan_triangles` to the triangles around p, anti-clockwise; at the boundary from one
  /// boundary edge to the other. Empty if p is not a vertex. O(triangles around p).
  void fan (Index p, std::vector<Index>& fan_triangles) const;

  /// The same, and sets `ring` to the points that share an edge with p: triangle k has the ring points
  /// k and k + 1 as its other corners.
  /// \return whether the fan is closed
  bool fan (Index p, std::vector<Index>& fan_triangles, std::vector<Index>& ring) const;

  /// True if p and q, both vertices, share an edge. Also true if both have more than 500 triangles.
  /// O(triangles around p).
  bool hasEdge (Index p, Index q) const;

  /// The triangle with these corners in any order, or NONE. O(triangles around them).
  Index triangleWith (const Triangle& corners) const;

  /// Replaces the edge by the other diagonal of its two triangles. It must not be a boundary edge,
  /// and the other diagonal must not be an edge yet. Afterwards triangle e.triangle has the corners
  /// (corner, from, opposite) and the other one (opposite, to, corner), in names before the flip;
  /// the new edge is side 1 of both.
  void flip (MeshEdge e);

  /// Appends the triangle of a boundary edge and a point p that is not a vertex.
  /// \return its edge opposite to p
  MeshEdge attach (MeshEdge e, Index p);

  /// Splits triangle t in three at point p, which must not be a vertex; the second and the third part
  /// become u and v, which must be unused.
  void split (Index t, Index p, Index u, Index v);

  /// Replaces the closed fan around p by a triangulation of the polygon around it, which has two
  /// triangles less. Its inner edges must not be edges yet. Afterwards p is not a vertex, and the
  /// last two triangles of the fan are unused.
  void replaceFan (Index p, const std::vector<Index>& fan_triangles,
                   const std::vector<Triangle>& filling);

  /// Forgets the recorded changes, and records those from here on.
  /// \param is_on false: records no longer
  void recordChanges (bool is_on = true)
  {
    changes_.clear ();
    is_recording_ = is_on;
  }

  /// The current state, for undo (). Requires recording.
  std::size_t mark () const { return changes_.size (); }

  /// Undoes all recorded changes since mark () returned this value, the last one first.
  void undo (std::size_t mark);

  /// The triangles of all recorded changes, ascending.
  std::vector<Index> changedTriangles () const;

  /// Sets neighbours and triangle_of from the triangles.
  /// O(n), on all threads. Temporarily 5 bytes per triangle, 12 if they are in random order.
  /// \param points number of points; corners must be below
  /// \param may_be_split of each point: whether it may have several fans; nullptr: none may
  /// \return false unless the triangles are an oriented manifold; the mesh is then unusable
  /// \throws IndexLimitReached if there are 2^32 / 3 triangles or more
  bool connect (std::size_t points, const RunContext& run, const Flags* may_be_split = nullptr);

private:
  // What was there before a change.
  struct Entry
  {
    Index triangle; // NONE: the entry belongs to a point
    Triangle corners;
    std::array<Index, 3> neighbors; // of a point: (point, its triangle, not used)
  };

  void link (Index t, std::uint8_t side, MeshEdge other);

  void set (Index t, const Triangle& corners)
  {
    note (t);
    triangles[t] = corners;
  }

  void setTriangleOf (Index p, Index t)
  {
    if (is_recording_)
      changes_.push_back ({NONE, {}, {p, triangle_of[p], NONE}});
    triangle_of[p] = t;
  }

  void note (Index t)
  {
    if (is_recording_)
      changes_.push_back ({t, triangles[t], neighbors[t]});
  }

  std::vector<Entry> changes_;
  bool is_recording_ = false;
};

/// Visits the triangles around a point: anti-clockwise, at the boundary then clockwise from the
/// start.
struct FanWalk
{
  const TriangleMesh& mesh;
  Index p;
  Index start = mesh.triangle_of[p];
  Index triangle = start; ///< NONE: no more
  bool is_clockwise = false;

  void advance ()
  {
    if (!is_clockwise) {
      triangle = mesh.neighbors[triangle][TriangleMesh::next (mesh.sideOf (triangle, p))];
      if (triangle != NONE) {
        if (triangle == start)
          triangle = NONE;
        return;
      }
      is_clockwise = true;
      triangle = start;
    }
    triangle = mesh.neighbors[triangle][TriangleMesh::previous (mesh.sideOf (triangle, p))];
  }
};

/// The boundary edges, in the order of their triangles. O(n).
std::vector<MeshEdge>
boundaryEdges (const TriangleMesh& mesh);

/// Of each point: whether it is on the boundary. O(n).
Flags
boundaryPoints (const TriangleMesh& mesh);

/// The points of each boundary loop in order, the surface on the left. A loop starts at its
/// smallest point; loops are sorted by these. O(n).
std::vector<std::vector<Index>>
boundaryLoops (const TriangleMesh& mesh, const RunContext& run);

/// Triangles; a smaller component beside a larger one is no piece of the surface. Chosen by hand; no
/// measurement is recorded.
constexpr std::size_t SMALLEST_ISLAND = 32;

/// Components of a mesh. The triangles of a component are connected by edges.
struct MeshComponents
{
  std::vector<Index> of_triangle; ///< numbered from 0 in the order of their first triangles
  Index count = 0;
};

/// O(n).
MeshComponents
findComponents (const TriangleMesh& mesh, const RunContext& run);

/// Number of vertices of each component. O(n).
std::vector<std::size_t>
countPoints (const TriangleMesh& mesh, const MeshComponents& components);

/// Adds one ring of vertices to a patch, and sorts it.
void
addRing (const TriangleMesh& mesh, std::vector<Index>& patch);

} // namespace pcl::floater
