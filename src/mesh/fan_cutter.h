// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Splits of vertices of a mesh, and the collapses that undo them.
#pragma once

#include "mesh/triangle_mesh.h"

#include <limits>
#include <vector>

namespace pcl::floater {
/// The triangles around a vertex and the places between them, anti-clockwise. Triangle k has the
/// places k and k + 1 as its other corners. Around a closed fan, places count on.
struct Fan
{
  std::vector<Index> triangles;
  std::vector<Index> ring;
  bool is_closed = false;

  std::size_t size () const { return triangles.size (); }
  Index triangle (std::size_t k) const { return triangles[k % size ()]; }
  Index at (std::size_t k) const { return ring[k % ring.size ()]; }
  /// The last place; around a closed fan, the first one again.
  std::size_t last () const { return size (); }
};

/// A part of the fan around a vertex, from one place to another.
struct Cut
{
  double cost = std::numeric_limits<double>::infinity ();
  Index vertex = NONE;
  std::size_t from = 0, to = 0;
  /// Whether a triangle with both points closes the cut there; at the boundary, one is enough.
  bool has_begin = true, has_end = true;
};

/// Where a point was that was taken out: the places of its part, by their points.
struct Return
{
  Index vertex = NONE, from = NONE, to = NONE; ///< NONE: no cut there
};

/// Cuts fans of a mesh open for new points, and closes them again. Manifold, topology and orientation
/// stay.
class FanCutter
{
public:
  explicit FanCutter (TriangleMesh& mesh) : mesh_ (mesh) {}

  void setFan (Index v, Fan& fan) const { fan.is_closed = mesh_.fan (v, fan.triangles, fan.ring); }

  /// The cut of a fan that gives a point its part back.
  static Cut cutAt (const Fan& fan, const Return& place);

  /// Gives p, which has no triangle, the part of a fan, and closes the cuts by triangles with both
  /// points.
  void split (const Cut& cut, Index p);

  /// Collapses p into its neighbour v.
  /// \return how to undo it; vertex NONE if it would change the topology: nothing is done then
  Return takeOut (Index p, Index v);

  /// Undoes takeOut ().
  void putBack (const Return& place, Index p);

  /// Removes the triangles that collapses left. Called at the end.
  void dropUnused (const RunContext& run);

private:
  Index newTriangle ();
  void relink (Index t, Index before, Index now);

  TriangleMesh& mesh_;
  std::vector<Index> unused_; // triangles
  Fan fan_, other_fan_;
};

} // namespace pcl::floater
