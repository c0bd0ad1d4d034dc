// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with the mesh in a place, before and after it is made anew.
#pragma once

#include "core/order_statistics.h"
#include "mesh/folds.h"
#include "mesh/two_sides.h"
#include "mesh/vertex_stars.h"

namespace pcl::floater {
/// A triangle, or its other side.
inline Triangle
turnedIf (bool is_turned, Triangle t)
{
  if (is_turned)
    std::swap (t[1], t[2]);
  return t;
}

/// The mesh in a place: the frame and other triangles.
class PieceInPlace
{
public:
  /// \param is_turned of each patch of the frame; empty: none is
  PieceInPlace (const Place& place, const std::vector<Triangle>& others, const Flags& is_turned,
                const RunContext& run)
      : place_ (place), made_ (others.size ())
  {
    for (std::size_t p = 0; p < place.positions.size (); ++p)
      is_inside_.push_back (place.is_free[p] | place.is_rim[p]);
    for (const Triangle& t : others)
      for (const Index p : t)
        is_inside_[p] = 1;
    mesh_.triangles = others;
    for (std::size_t i = 0; i < place.frame.size (); ++i)
      mesh_.triangles.push_back (
          turnedIf (!is_turned.empty () && is_turned[place.patch_of[i]] != 0, place.frame[i]));
    Flags is_outside; // of each point: some of its triangles may be missing
    for (std::size_t p = 0; p < place.positions.size (); ++p)
      is_outside.push_back (isInside (p) || place.is_whole[p] != 0 ? 0 : 1);
    is_manifold_ = mesh_.connect (place.positions.size (), run, &is_outside);
  }

  bool isManifold () const { return is_manifold_; }

  /// Points inside that have triangles, but not a single fan, closed but at boundaries that stay.
  /// \param webs if not nullptr: of each of the other triangles, whether it belongs to one fan of several
  ///     at such a point, between points that were on a boundary before
  std::vector<Index> misfits (const RunContext& run, Flags* webs = nullptr) const
  {
    std::vector<Index> found;
    if (webs != nullptr)
      webs->assign (made_, 0);
    const auto stays = [this] (Index q) { return place_.is_boundary[q] != 0; };
    const TriangleRanges ranges (mesh_.triangles, place_.positions.size (), run);
    StarOrder order;
    for (std::size_t r = 0; r < ranges.count (); ++r) {
      const VertexStars stars (mesh_.triangles, ranges, r);
      for (auto p = static_cast<Index> (ranges.firstPoint (r)); p < ranges.lastPoint (r); ++p) {
        const VertexStar star = stars.of (p);
        if (!isInside (p) || star.size () == 0)
          continue;
        const bool is_proper = order.set (star);
        bool fits = is_proper && order.isOneFan ();
        for (std::size_t i = 0; i < star.size () && fits; ++i)
          fits = (order.before (i) != NONE || (stays (p) && stays (star[i].next))) &&
                 (order.after (i) != NONE || (stays (p) && stays (star[i].previous)));
        if (!fits)
          found.push_back (p);
        if (!fits && webs != nullptr && is_proper && !order.isOneFan ())
          markWebs (star, order, *webs);
      }
    }
    return found;
  }

  /// Triangles that cross, folds, open edges that are not of a boundary that stays, and points inside
  /// without a triangle.
  std::size_t faults (const RunContext& run) const
  {
    std::size_t count = findFolds (mesh_, place_.positions, run).size () +
                        findSelfIntersections (mesh_.triangles, place_.positions, run).size ();
    for (const MeshEdge e : boundaryEdges (mesh_))
      if (const Index from = mesh_.from (e), to = mesh_.to (e);
          (isInside (from) || isInside (to)) &&
          (place_.is_boundary[from] == 0 || place_.is_boundary[to] == 0))
        ++count;
    for (std::size_t p = 0; p < place_.positions.size (); ++p)
      count += isInside (p) && mesh_.triangle_of[p] == NONE ? 1 : 0;
    return count;
  }

private:
  bool isInside (std::size_t p) const { return is_inside_[p] != 0; }

  void markWebs (const VertexStar& star, const StarOrder& order, Flags& webs) const
  {
    for (Index first = 0; first < star.size (); ++first) {
      if (order.before (first) != NONE)
        continue;
      std::vector<Index> fan;
      for (Index i = first; i != NONE && fan.size () < star.size (); i = order.after (i))
        fan.push_back (star[i].triangle);
      const bool is_web = std::all_of (fan.begin (), fan.end (), [this] (Index t) {
        return t < made_ && !anyCorner (mesh_.triangles[t],
                                        [this] (Index p) { return place_.was_boundary[p] == 0; });
      });
      for (const Index t : fan)
        if (is_web)
          webs[t] = 1;
    }
  }

  const Place& place_;
  std::size_t made_; // triangles that are not of the frame
  TriangleMesh mesh_;
  Flags is_inside_; // of each point: free, on the rim, or in other triangles
  bool is_manifold_ = false;
};

} // namespace pcl::floater
