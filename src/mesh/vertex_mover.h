// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Moves single vertices of a mesh to other triangles.
#pragma once

#include "mesh/flips.h"
#include "mesh/hole_filling.h"

#include <vector>

namespace pcl::floater {
/// Removes a vertex, fills its hole by the triangulation of least cost (see PolygonFilling),
/// inserts it into a triangle at one of its nearest neighbours, on any sheet, and flips edges
/// around both. Vertices at the boundary and with too many triangles are not moved. While the mover
/// exists, the mesh records its changes, so that they can be undone exactly.
class VertexMover
{
public:
  /// A smaller change of cost may be rounding. An equilateral triangle costs 1.73.
  static constexpr double IMPROVES = 1e-6;

  /// \param neighbors   nearest neighbours of each point
  /// \param largest_fan triangles; a vertex with more of them is not moved
  VertexMover (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
               std::size_t largest_fan, const RunContext& run)
      : mesh_ (mesh), neighbors_ (neighbors), largest_fan_ (largest_fan), cost_ (cost),
        flipper_ (mesh, cost_, run), filling_ (run), offered_ (mesh.triangles.size (), 0)
  {
    mesh_.recordChanges ();
  }
  VertexMover (const VertexMover&) = delete;
  VertexMover& operator= (const VertexMover&) = delete;
  ~VertexMover () { mesh_.recordChanges (false); }

  /// A triangle for the insertion of a vertex.
  struct Place
  {
    double added; ///< cost of its split at the vertex
    Index triangle;
  };

  /// Triangles for a vertex, the cheapest first. The mesh stays unchanged.
  /// \param most maximum number of triangles
  /// \return empty if the vertex cannot be removed
  std::vector<Place> placesFor (Index v, std::size_t most);

  /// Moves the vertex for which placesFor () was called last, in the state of the mesh then.
  /// \param place one that was found for it
  void moveTo (Index v, const Place& place);

  /// Removes vertices, except immovable ones, and reinserts them one by one, each where it then
  /// costs least.
  /// \param vertices each once; the last one is inserted first
  /// \return false if one of them fits nowhere; then the caller has to undo
  bool rebuild (const std::vector<Index>& vertices);

  CachedCost& cost () { return cost_; }

private:
  bool fillHoleOf (Index v);
  void takeOut (Index v);
  void settleAt (Index v, Index t);
  const std::vector<Place>& findPlaces (Index v, std::size_t most);
  void offer (Index t, Index v, std::size_t most);

  TriangleMesh& mesh_;
  const CsrLists& neighbors_;
  std::size_t largest_fan_;
  CachedCost cost_;
  EdgeFlipper flipper_;
  PolygonFilling filling_;
  std::vector<Triangle> filled_; // the filling of the hole that a vertex leaves
  std::vector<Index> slots_;     // triangles of that hole; the last two are unused
  std::vector<Index> fan_, polygon_;
  std::vector<Place> places_;          // cheapest first
  std::vector<std::uint32_t> offered_; // per triangle: the last search that visited it
  std::uint32_t search_ = 0;
};

} // namespace pcl::floater
