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
      : mesh_ (mesh), neighbors_ (neighbors), cost_{cost},
        splitter_ (mesh, positions, PLACES, true), flipper_{mesh, cost_, run}, filling_ (run)
  {
    mesh_.recordChanges ();
  }
  VertexMover (const VertexMover&) = delete;
  VertexMover& operator= (const VertexMover&) = delete;
  ~VertexMover () { mesh_.recordChanges (false); }

  /// Cuts for a vertex, the cheapest first. The mesh stays unchanged.
  /// \return empty if the vertex cannot be removed
  std::vector<Cut> cutsFor (Index v)
  {
    if (!fillHoleOf (v))
      return {};
    const std::size_t before = mesh_.mark ();
    takeOut (v);
    std::vector<Cut> cuts = splitter_.cutsFor (v, neighbors_.row (v));
    mesh_.undo (before);
    return cuts;
  }

  /// Moves the vertex for which cutsFor () was called last, in the state of the mesh then.
  /// \param cut one that was found for it
  void moveTo (Index v, const Cut& cut)
  {
    takeOut (v);
    settle (v, cut);
  }

  /// Removes vertices, except immovable ones, and lets them join again one by one, each where it then
  /// costs least.
  /// \param vertices each once; the last one joins first
  /// \return false if one of them fits nowhere; then the caller has to undo
  bool rebuild (const std::vector<Index>& vertices)
  {
    std::vector<Index> out, unused; // vertices, and triangles: two for each of them
    for (const Index v : vertices) {
      if (!fillHoleOf (v))
        continue;
      takeOut (v);
      out.push_back (v);
      unused.insert (unused.end (), slots_.end () - 2, slots_.end ());
    }
    for (; !out.empty (); out.pop_back (), unused.resize (unused.size () - 2)) {
      const std::vector<Cut>& cuts = splitter_.cutsFor (out.back (), neighbors_.row (out.back ()));
      if (cuts.empty ())
        return false;
      slots_.assign (unused.end () - 2, unused.end ());
      settle (out.back (), cuts.front ());
    }
    return true;
  }

  CachedCost& cost () { return cost_; }

private:
  // Triangles around a vertex that is moved; 12, 16 and 40 leave about as many flaws. And neighbours
  // whose fans may be split; so do 4 and 12.
  static constexpr std::size_t LARGEST_FAN = 24, PLACES = 8;

  // Finds the filling of the hole that a vertex leaves. Returns false if it cannot leave.
  bool fillHoleOf (Index v)
  {
    if (!mesh_.fan (v, fan_, polygon_) || fan_.size () < 3 || fan_.size () > LARGEST_FAN)
      return false;
    filled_ = filling_.fill (
        polygon_,
        [this] (Index p, Index q, Index r) {
          return cost_ ({p, q, r}).cost;
        },
        [this] (Index p, Index q) { return !mesh_.hasEdge (p, q); });
    if (filled_.size () != 1)
      return !filled_.empty ();
    // The mesh must not have the reversed triangle: the fourth one of a tetrahedron.
    const Triangle& corners = filled_.front ();
    mesh_.fan (corners[0], fan_);
    return std::none_of (fan_.begin (), fan_.end (), [&] (Index t) {
      return isCorner (mesh_.triangles[t], corners[1]) && isCorner (mesh_.triangles[t], corners[2]);
    });
  }

  // Puts the filling in the place of a vertex.
  void takeOut (Index v)
  {
    mesh_.fan (v, slots_);
    mesh_.replaceFan (v, slots_, filled_);
  }

  // Lets a vertex join by the two free slots, and flips edges around it and its old hole.
  void settle (Index v, const Cut& cut)
  {
    splitter_.split (cut, v, slots_[slots_.size () - 2], slots_.back ());
    mesh_.fan (v, fan_);
    fan_.insert (fan_.end (), slots_.begin (), slots_.end () - 2);
    for (const Index u : fan_)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index other = mesh_.neighbors[u][side];
        if (other != NONE &&
            (u < other || std::find (fan_.begin (), fan_.end (), other) == fan_.end ()))
          flipper_.stack.push_back ({u, side});
      }
    flipper_.flipAll ();
  }

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
