// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Adds points to a mesh by vertex splits.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// A part of the fan around a vertex, from one place of the ring around it to another. A new point
/// takes it over.
struct Cut
{
  double cost = std::numeric_limits<double>::infinity ();
  Index vertex = NONE;
  std::size_t from = 0, to = 0;
  // Whether a triangle with both points closes the cut there; at the boundary, one is enough.
  bool has_begin = true, has_end = true;
};

/// Splits vertices. A split cuts the fan of a vertex along two edges, or one at the boundary, gives a
/// new point a part of it, and closes the cuts by triangles with both points (the inverse of an edge
/// collapse: Hoppe 1996). So neither manifold nor topology nor orientation can change.
///
/// The costs of a mesh are lengths. Its bending is the sum over its edges of length times angle
/// between the triangles: bounded for needles. The other costs were chosen by hand, on points that
/// lie on one another; without one of them, crossing triangles or folds became many times as many.
class VertexSplitter
{
public:
  /// \param positions      must outlive this, as must the mesh
  /// \param nearest        number of vertices whose fans may be split
  /// \param keeps_boundary true: no cut lets the boundary pass through the new point
  VertexSplitter (TriangleMesh& mesh, const Positions& positions, std::size_t nearest,
                  bool keeps_boundary)
      : mesh_ (mesh), positions_ (positions), nearest_ (nearest), keeps_boundary_ (keeps_boundary)
  {
  }

  /// The cheapest cut for a point at each of the first vertices in a row, the cheapest first. Valid
  /// until the next call. O(f^2) for fans of f triangles.
  const std::vector<Cut>& cutsFor (Index p, Row near);

  /// Gives a point its part, in the state of the mesh when the cut was found. Appends triangles.
  void split (const Cut& cut, Index p);

  /// The same with two triangles that are unused, for a cut with both ends.
  void split (const Cut& cut, Index p, Index u, Index v);

private:
  // The triangles around a vertex and the places between them, anti-clockwise. Triangle k has the
  // places k and k + 1 as its other corners. Around a closed fan, places count on.
  struct Fan
  {
    std::vector<Index> triangles;
    std::vector<Index> ring;
    bool is_closed = false;

    std::size_t size () const { return triangles.size (); }
    Index triangle (std::size_t k) const { return triangles[k % size ()]; }
    Index at (std::size_t k) const { return ring[k % ring.size ()]; }
  };

  // At a place, for the vertex v of the fan and the new point p.
  struct Place
  {
    double length_v, length_p;   // of the spokes
    double spoke_v, spoke_p;     // their costs
    double rim;                  // change of the edge that follows
    double first, last;          // of a cut that begins or ends there
    Vector3d normal_v, normal_p; // of the triangle that follows
    Vector3d needle;             // normal of the triangle (v, place, p)
  };

  Vector3d normalOf (Index t) const;
  void setFan (Index v) { fan_.is_closed = mesh_.fan (v, fan_.triangles, fan_.ring); }
  Cut bestCut (Index v, Index p);
  void turnSpokes (const Cut& cut, Index p, MeshEdge spoke, std::size_t count);

  TriangleMesh& mesh_;
  const Positions& positions_;
  std::size_t nearest_;
  bool keeps_boundary_;
  Fan fan_;
  std::vector<Place> places_;                      // of the fan
  std::vector<double> rims_, spokes_v_, spokes_p_; // sums of those before a place
  std::vector<Cut> cuts_;
};

/// Adds points to a mesh: each, in the given order, by the cheapest split of one of the nearest
/// vertices. One thread, O(log n) for each point, about 6 microseconds.
/// \param added points without triangles
void
splitVertices (TriangleMesh& mesh, const Positions& positions, const std::vector<Index>& added,
               const RunContext& run);

/// Adds all points without triangles in the same way, each beside its nearest neighbours that have
/// some, if there are any. One thread, about 6 microseconds for each point.
/// \param neighbors of each point, nearest first
/// \return number of points added
std::size_t
addMissingPoints (TriangleMesh& mesh, const Positions& positions, const CsrLists& neighbors,
                  const RunContext& run);

} // namespace pcl::floater
