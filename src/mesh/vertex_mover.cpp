// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_mover.h"

namespace pcl::floater {
// Finds the filling of the hole that a vertex leaves. Returns false if it cannot leave.
bool
VertexMover::fillHoleOf (Index v)
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
void
VertexMover::takeOut (Index v)
{
  mesh_.fan (v, slots_);
  mesh_.replaceFan (v, slots_, filled_);
}

std::vector<Cut>
VertexMover::cutsFor (Index v)
{
  if (!fillHoleOf (v))
    return {};
  const std::size_t before = mesh_.mark ();
  takeOut (v);
  std::vector<Cut> cuts = splitter_.cutsFor (v, neighbors_.row (v));
  mesh_.undo (before);
  return cuts;
}

void
VertexMover::moveTo (Index v, const Cut& cut)
{
  takeOut (v);
  settle (v, cut);
}

// Lets a vertex join by the two free slots, and flips edges around it and its old hole.
void
VertexMover::settle (Index v, const Cut& cut)
{
  splitter_.split (cut, v, slots_[slots_.size () - 2], slots_.back ());
  mesh_.fan (v, fan_);
  fan_.insert (fan_.end (), slots_.begin (), slots_.end () - 2);
  for (const Index u : fan_)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index other = mesh_.neighbors[u][side];
      if (other != NONE &&
          (u < other || std::find (fan_.begin (), fan_.end (), other) == fan_.end ()))
        flipper_.push ({u, side});
    }
  flipper_.run ();
}

bool
VertexMover::rebuild (const std::vector<Index>& vertices)
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

} // namespace pcl::floater
