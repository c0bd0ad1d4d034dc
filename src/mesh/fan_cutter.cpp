// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fan_cutter.h"

#include <algorithm>

namespace pcl::floater {
Cut
FanCutter::cutAt (const Fan& fan, const Return& place)
{
  const auto placeOf = [&fan] (Index p) {
    return static_cast<std::size_t> (std::find (fan.ring.begin (), fan.ring.end (), p) -
                                     fan.ring.begin ());
  };
  Cut cut;
  cut.vertex = place.vertex;
  cut.has_begin = place.from != NONE;
  cut.has_end = place.to != NONE;
  cut.from = cut.has_begin ? placeOf (place.from) : 0;
  cut.to = cut.has_end ? placeOf (place.to) : fan.last ();
  if (fan.is_closed && cut.to <= cut.from)
    cut.to += fan.size ();
  return cut;
}

Index
FanCutter::newTriangle ()
{
  if (!unused_.empty ()) {
    const Index t = unused_.back ();
    unused_.pop_back ();
    return t;
  }
  mesh_.triangles.emplace_back ();
  mesh_.neighbors.push_back ({NONE, NONE, NONE});
  return static_cast<Index> (mesh_.triangles.size () - 1);
}

// Replaces a neighbour of t.
void
FanCutter::relink (Index t, Index before, Index now)
{
  if (t != NONE)
    for (Index& neighbor : mesh_.neighbors[t])
      if (neighbor == before) {
        neighbor = now;
        return;
      }
}

void
FanCutter::split (const Cut& cut, Index p)
{
  const Index v = cut.vertex;
  setFan (v, fan_);
  const std::size_t m = fan_.size (), from = cut.from, to = cut.to;
  // Triangles beside the ends of the part, outside and inside; NONE at the boundary.
  const auto outside = [&] (std::size_t k) { return fan_.triangle (k); };
  const Index before = from > 0 || fan_.is_closed ? outside (from + m - 1) : NONE;
  const Index after = to < m || fan_.is_closed ? outside (to) : NONE;
  const Index first = to > from ? outside (from) : NONE;
  const Index last = to > from ? outside (to + m - 1) : NONE;
  const Index from_point = fan_.at (from), to_point = fan_.at (to);
  for (std::size_t k = from; k < to; ++k) {
    Triangle& corners = mesh_.triangles[fan_.triangle (k)];
    corners[mesh_.sideOf (fan_.triangle (k), v)] = p;
  }
  const Index begin = cut.has_begin ? newTriangle () : NONE;
  const Index end = cut.has_end ? newTriangle () : NONE;
  if (begin != NONE) {
    mesh_.triangles[begin] = {v, from_point, p};
    mesh_.neighbors[begin] = {first, end, before};
    // The edge of `before` that follows its first corner on the ring.
    if (before != NONE)
      mesh_.neighbors[before][TriangleMesh::next (mesh_.sideOf (before, v))] = begin;
    if (first != NONE)
      mesh_.neighbors[first][TriangleMesh::previous (mesh_.sideOf (first, p))] = begin;
  }
  if (end != NONE) {
    mesh_.triangles[end] = {v, p, to_point};
    mesh_.neighbors[end] = {last, after, begin};
    if (last != NONE)
      mesh_.neighbors[last][TriangleMesh::next (mesh_.sideOf (last, p))] = end;
    if (after != NONE)
      mesh_.neighbors[after][TriangleMesh::previous (mesh_.sideOf (after, v))] = end;
  }
  mesh_.triangle_of[v] = mesh_.triangle_of[p] = begin != NONE ? begin : end;
}

Return
FanCutter::takeOut (Index p, Index v)
{
  setFan (p, other_fan_);
  setFan (v, fan_);
  const auto place = std::find (other_fan_.ring.begin (), other_fan_.ring.end (), v);
  const auto k = static_cast<std::size_t> (place - other_fan_.ring.begin ());
  const std::size_t m = other_fan_.size ();
  // The triangles that go: (p, v, from), which follows v around p, and (p, to, v) before it.
  const Index begin = k < m ? other_fan_.triangles[k] : NONE;
  const Index end = k > 0                  ? other_fan_.triangles[k - 1]
                    : other_fan_.is_closed ? other_fan_.triangles[m - 1]
                                           : NONE;
  Return result;
  result.from = begin != NONE ? other_fan_.at (k + 1) : NONE;
  result.to = end != NONE ? other_fan_.at (k + other_fan_.ring.size () - 1) : NONE;
  const bool is_boundary_edge = begin == NONE || end == NONE;
  if (!other_fan_.is_closed && !is_boundary_edge)
    return {};
  if (m == 3 && fan_.size () == 3 && other_fan_.is_closed && fan_.is_closed)
    return {};
  for (const Index q : other_fan_.ring)
    if (q != v && q != result.from && q != result.to &&
        std::find (fan_.ring.begin (), fan_.ring.end (), q) != fan_.ring.end ())
      return {};
  // The two other edges of a triangle that goes must not both be of the boundary.
  const auto across = [this] (Index t, Index corner) {
    return mesh_.neighbors[t][mesh_.sideOf (t, corner)];
  };
  for (const Index t : {begin, end})
    if (t != NONE && across (t, p) == NONE && across (t, v) == NONE)
      return {};
  if (begin != NONE && end != NONE && across (begin, p) == end)
    return {};
  for (const Index t : other_fan_.triangles)
    mesh_.triangles[t][mesh_.sideOf (t, p)] = v;
  Index left = NONE; // a triangle at v
  for (const Index t : {begin, end}) {
    if (t == NONE)
      continue;
    // Both corners are v now: the edges to the third corner are joined.
    const Index third = t == begin ? result.from : result.to;
    const Triangle corners = mesh_.triangles[t];
    Index sides[2] = {NONE, NONE};
    std::size_t found = 0;
    for (std::uint8_t side = 0; side < 3; ++side)
      if (corners[side] == v)
        sides[found++] = mesh_.neighbors[t][side];
    relink (sides[0], t, sides[1]);
    relink (sides[1], t, sides[0]);
    for (const Index other : sides)
      if (other != NONE && other != begin && other != end) {
        left = other;
        mesh_.triangle_of[third] = other;
      }
    unused_.push_back (t);
  }
  mesh_.triangle_of[v] = left;
  mesh_.triangle_of[p] = NONE;
  result.vertex = v;
  return result;
}

void
FanCutter::putBack (const Return& place, Index p)
{
  setFan (place.vertex, fan_);
  split (cutAt (fan_, place), p);
}

void
FanCutter::dropUnused (const RunContext& run)
{
  if (unused_.empty ())
    return;
  std::sort (unused_.begin (), unused_.end ());
  std::size_t next = 0, kept = 0;
  for (std::size_t t = 0; t < mesh_.triangles.size (); ++t)
    if (next < unused_.size () && unused_[next] == t)
      ++next;
    else
      mesh_.triangles[kept++] = mesh_.triangles[t];
  mesh_.triangles.resize (kept);
  mesh_.connect (mesh_.triangle_of.size (), run);
}

} // namespace pcl::floater
