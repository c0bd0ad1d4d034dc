// SPDX-License-Identifier: GPL-3.0-or-later
// Single vertices taken out of a mesh and put back elsewhere.
#pragma once

#include "mesh/flips.h"
#include "mesh/polygon_filling.h"

#include <utility>
#include <vector>

namespace pcl
{
namespace floater
{
/// Takes a vertex out, fills its hole by the triangulation of least cost, and puts it back into a
/// triangle around its nearest neighbours, on whatever sheet, with flips from there. Vertices at
/// the boundary and those of more than 16 triangles stay. While it lives, changes of the mesh are
/// noted in its journal; with flips, an undone mesh is what it was, bit by bit.
class VertexMover
{
public:
  /// Changes of cost below are none: of the cost of a triangle of equal sides.
  static constexpr double IMPROVES = 1e-6;

  VertexMover (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
               const RunContext& run)
      : mesh_ (mesh), neighbors_ (neighbors), cost_ (cost), flipper_ (mesh, cost_, run),
        offered_ (mesh.triangles.size (), 0)
  {
    mesh_.recordChanges ();
  }
  VertexMover (const VertexMover&) = delete;
  VertexMover& operator= (const VertexMover&) = delete;
  ~VertexMover () { mesh_.recordChanges (false); }

  /// Moves a vertex to the place where the cost of the mesh gets least, if less than now.
  /// \param tried places where flips are tried: those where the split alone adds least
  /// \return the change of cost, 0 if the vertex stays
  double move (Index v, std::size_t tried);

  /// Moves a vertex to the place of a rank, from 0, by the cost that the split adds there.
  /// \return false if there is no such place, or the vertex cannot be taken out
  bool moveTo (Index v, std::size_t rank, double& change);

  /// The cost, as this remembers it.
  CachedCost& cost () { return cost_; }

  /// Changes since the last call of start.
  void start () { mesh_.recordChanges (); }
  void undo () { mesh_.undo (0); }
  const MeshJournal& journal () const { return mesh_.journal; }

  /// Old and new neighbours of the vertices moved, appended, also where that was undone later.
  std::vector<Index>& dirty () { return dirty_; }

private:
  double costOf (const Index* first, const Index* last);
  bool takeOut (Index v, double& change);
  void touch (Index v);
  double settleAt (Index v, Index t);
  bool isTriangle (const Triangle& corners);
  const std::vector<std::pair<double, Index>>& places (Index v, std::size_t most);
  void offer (Index t, Index v, std::size_t most);

  TriangleMesh& mesh_;
  const CsrLists& neighbors_;
  CachedCost cost_;
  EdgeFlipper flipper_;
  PolygonFilling filling_;
  std::vector<Triangle> filled_; // of the hole that the vertex taken out has left ...
  std::vector<Index> slots_;     // ... in these but for the last two, which are free
  std::vector<Index> fan_, polygon_, dirty_;
  std::vector<std::pair<double, Index>> places_; // cheapest first
  std::vector<std::uint32_t> offered_; // per triangle: the search for places that saw it last
  std::uint32_t search_ = 0;
};

} // namespace floater
} // namespace pcl
