// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Moves single vertices of a mesh to other triangles.
#pragma once

#include "mesh/flips.h"
#include "mesh/hole_filling.h"
#include "mesh/vertex_splits.h"

namespace pcl::floater {
/// Removes a vertex, fills its hole by the triangulation of least cost (see PolygonFilling), and lets
/// it join the mesh again by the split of one of its nearest neighbours, on any sheet (see
/// VertexSplitter), with flips of edges around both. Vertices at the boundary and with too many triangles are not moved. While the
/// mover exists, the mesh records its changes, so that they can be undone exactly.
class VertexMover
{
public:
  /// A smaller change of cost may be rounding. An equilateral triangle costs 1.73.
  static constexpr double IMPROVES = 1e-6;

  /// \param neighbors nearest neighbours of each point
  VertexMover (TriangleMesh& mesh, const Positions& positions, const CsrLists& neighbors,
               const TriangleCost& cost, const RunContext& run)
      : mesh_ (mesh), neighbors_ (neighbors), cost_ (cost),
        splitter_ (mesh, positions, PLACES, true), flipper_ (mesh, cost_, run), filling_ (run)
  {
    mesh_.recordChanges ();
  }
  VertexMover (const VertexMover&) = delete;
  VertexMover& operator= (const VertexMover&) = delete;
  ~VertexMover () { mesh_.recordChanges (false); }

  /// Cuts for a vertex, the cheapest first. The mesh stays unchanged.
  /// \return empty if the vertex cannot be removed
  std::vector<Cut> cutsFor (Index v);

  /// Moves the vertex for which cutsFor () was called last, in the state of the mesh then.
  /// \param cut one that was found for it
  void moveTo (Index v, const Cut& cut);

  /// Removes vertices, except immovable ones, and lets them join again one by one, each where it then
  /// costs least.
  /// \param vertices each once; the last one joins first
  /// \return false if one of them fits nowhere; then the caller has to undo
  bool rebuild (const std::vector<Index>& vertices);

  CachedCost& cost () { return cost_; }

private:
  // Triangles around a vertex that is moved; 12, 16 and 40 leave about as many flaws. And neighbours
  // whose fans may be split; so do 4 and 12.
  static constexpr std::size_t LARGEST_FAN = 24, PLACES = 8;

  bool fillHoleOf (Index v);
  void takeOut (Index v);
  void settle (Index v, const Cut& cut);

  TriangleMesh& mesh_;
  const CsrLists& neighbors_;
  CachedCost cost_;
  VertexSplitter splitter_;
  EdgeFlipper flipper_;
  PolygonFilling filling_;
  std::vector<Triangle> filled_; // the filling of the hole that a vertex leaves
  std::vector<Index> slots_;     // triangles of that hole; the last two are unused
  std::vector<Index> fan_, polygon_;
};

} // namespace pcl::floater
