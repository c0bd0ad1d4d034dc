// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_mover.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace pcl::floater {
// Finds the filling of the hole that a vertex leaves. Returns false if it cannot leave.
bool
VertexMover::fillHoleOf (Index v)
{
  if (!mesh_.fan (v, fan_, polygon_) || fan_.size () < 3 || fan_.size () > largest_fan_)
    return false;
  filled_ = filling_.fill (
      polygon_, [this] (Index p, Index q, Index r) { return cost_ (p, q, r).cost; },
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

std::vector<VertexMover::Place>
VertexMover::placesFor (Index v, std::size_t most)
{
  if (!fillHoleOf (v))
    return {};
  const std::size_t before = mesh_.mark ();
  takeOut (v);
  const std::vector<Place> places = findPlaces (v, most);
  mesh_.undo (before);
  return places;
}

void
VertexMover::moveTo (Index v, const Place& place)
{
  takeOut (v);
  settleAt (v, place.triangle);
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
    slots_.assign (unused.end () - 2, unused.end ());
    if (findPlaces (out.back (), 1).empty ())
      return false;
    settleAt (out.back (), places_.front ().triangle);
  }
  return true;
}

// Splits triangle t at a vertex, using the two free slots, and flips edges around the vertex and
// its old hole.
void
VertexMover::settleAt (Index v, Index t)
{
  mesh_.split (t, v, slots_[slots_.size () - 2], slots_.back ());
  mesh_.fan (v, fan_);
  fan_.insert (fan_.end (), slots_.begin (), slots_.end () - 2);
  for (Index u : fan_)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index other = mesh_.neighbors[u][side];
      if (other != NONE &&
          (u < other || std::find (fan_.begin (), fan_.end (), other) == fan_.end ()))
        flipper_.push ({u, side});
    }
  flipper_.run ();
}

// The triangles with the cheapest splits at the vertex, at most `most`.
const std::vector<VertexMover::Place>&
VertexMover::findPlaces (Index v, std::size_t most)
{
  places_.clear ();
  if (most == 0)
    return places_;
  ++search_;
  for (std::size_t i = 0; i + 2 < slots_.size (); ++i)
    offer (slots_[i], v, most);
  for (Index q : neighbors_.row (v)) {
    mesh_.fan (q, fan_);
    for (Index t : fan_)
      offer (t, v, most);
  }
  return places_;
}

// Adds a triangle to the cheapest ones if it belongs there and was not visited.
void
VertexMover::offer (Index t, Index v, std::size_t most)
{
  if (offered_[t] == search_)
    return;
  offered_[t] = search_;
  const double limit =
      places_.size () < most ? std::numeric_limits<double>::infinity () : places_.back ().added;
  const Place place{splitCost (mesh_, cost_, t, v, limit), t};
  const auto isCheaper = [] (const Place& a, const Place& b) {
    return std::tie (a.added, a.triangle) < std::tie (b.added, b.triangle);
  };
  if (places_.size () == most) {
    if (!isCheaper (place, places_.back ()))
      return;
    places_.pop_back ();
  }
  places_.insert (std::upper_bound (places_.begin (), places_.end (), place, isCheaper), place);
}

} // namespace pcl::floater
