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
      : place_ (place)
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
  std::vector<Index> misfits (const RunContext& run) const
  {
    std::vector<Index> found;
    const auto stays = [this] (Index q) { return place_.is_boundary[q] != 0; };
    const TriangleRanges ranges (mesh_.triangles, place_.positions.size (), run);
    StarOrder order;
    for (std::size_t r = 0; r < ranges.count (); ++r) {
      const VertexStars stars (mesh_.triangles, ranges, r);
      for (auto p = static_cast<Index> (ranges.firstPoint (r)); p < ranges.lastPoint (r); ++p) {
        const VertexStar star = stars.of (p);
        if (!isInside (p) || star.size () == 0)
          continue;
        bool fits = order.set (star) && order.isOneFan ();
        for (std::size_t i = 0; i < star.size () && fits; ++i)
          fits = (order.before (i) != NONE || (stays (p) && stays (star[i].next))) &&
                 (order.after (i) != NONE || (stays (p) && stays (star[i].previous)));
        if (!fits)
          found.push_back (p);
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

  const Place& place_;
  TriangleMesh mesh_;
  Flags is_inside_; // of each point: free, on the rim, or in other triangles
  bool is_manifold_ = false;
};

} // namespace pcl::floater
