// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Takes single vertices out of a mesh and puts them back elsewhere.
#pragma once

#include "mesh/flips.h"
#include "mesh/polygon_filling.h"

#include <vector>

namespace pcl::floater {
/// Takes a vertex out, fills its hole by the triangulation of least cost (see PolygonFilling), puts
/// it back into a triangle at one of its nearest neighbours, on whatever sheet, and flips edges
/// around both places. Vertices at the boundary and those with too many triangles stay. As long as
/// the mover exists, the mesh records its changes, so that they can be undone to the last bit.
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

  /// Moves a vertex to the place where the cost of the mesh is least, if it is less than now.
  /// \param tried number of places that are tried: those where the split itself costs least
  /// \return change of the cost of the mesh: below 0, or 0 if the vertex stays
  double move (Index v, std::size_t tried);

  /// A triangle that a vertex can be put into.
  struct Place
  {
    double added; ///< cost of its split at the vertex
    Index triangle;
  };

  /// Where a vertex can be put, the cheapest first. The mesh stays as it is.
  /// \param most number of places that are asked for
  /// \return empty if the vertex cannot be taken out
  std::vector<Place> placesFor (Index v, std::size_t most);

  /// Moves a vertex to a place that was found for it in this state of the mesh.
  /// \return change of the cost of the mesh
  double moveTo (Index v, const Place& place);

  /// Takes vertices out, all that can be, and puts them back one by one, each where that costs
  /// least then.
  /// \param vertices each once; the last one is put back first
  /// \param change   set to the change of the cost of the mesh
  /// \return false if one of them has no place left; then the caller has to undo
  bool rebuild (const std::vector<Index>& vertices, double& change);

  CachedCost& cost () { return cost_; }

  /// The journal has the changes since the last call of start, and undo undoes them.
  void start () { mesh_.recordChanges (); }
  void undo () { mesh_.undo (0); }
  const MeshJournal& journal () const { return mesh_.journal; }

  /// Old and new neighbours of all vertices that were moved, also of moves that were undone later.
  /// New ones are appended; the caller clears the list.
  std::vector<Index>& dirty () { return dirty_; }

private:
  double costOf (const Index* first, const Index* last);
  bool takeOut (Index v, double& change);
  void markDirty (Index v);
  double settleAt (Index v, Index t);
  bool isTriangle (const Triangle& corners);
  const std::vector<Place>& findPlaces (Index v, std::size_t most);
  void offer (Index t, Index v, std::size_t most);

  TriangleMesh& mesh_;
  const CsrLists& neighbors_;
  std::size_t largest_fan_;
  CachedCost cost_;
  EdgeFlipper flipper_;
  PolygonFilling filling_;
  std::vector<Triangle> filled_; // the filling of the hole that a vertex has left
  std::vector<Index> slots_;     // the triangles of that hole; the last two are not in use
  std::vector<Index> fan_, polygon_, dirty_;
  std::vector<Place> places_;          // cheapest first
  std::vector<std::uint32_t> offered_; // per triangle: the last search that looked at it
  std::uint32_t search_ = 0;
};

} // namespace pcl::floater
