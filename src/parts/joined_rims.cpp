// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/joined_rims.h"

#include <algorithm>
#include <utility>

namespace pcl::floater {
namespace {
// Inserts values between others. `place` is the new index of each value.
template <typename Value>
void
spread (const std::vector<Index>& place, std::size_t count, const Value& between,
        std::vector<Value>& values)
{
  if (count == values.size ())
    return;
  std::vector<Value> all (count, between);
  for (std::size_t i = 0; i < place.size (); ++i)
    all[place[i]] = values[i];
  values = std::move (all);
}

template <typename Value>
void
append (const std::vector<Value>& values, std::vector<Value>& all)
{
  all.insert (all.end (), values.begin (), values.end ());
}

} // namespace

const RimTriangle*
JoinedRims::find (Triangle corners) const
{
  std::sort (corners.begin (), corners.end ());
  const auto at =
      std::lower_bound (origins.begin (), origins.end (), corners,
                        [] (const RimTriangle& a, const Triangle& b) { return a.ascending < b; });
  return at != origins.end () && at->ascending == corners ? &*at : nullptr;
}

void
RimJoiner::add (const PartRim& rim)
{
  addTriangles (rim);
  append (rim.points, points_);
  append (rim.positions, joined_.positions);
  append (rim.normals, joined_.normals);
  append (rim.smoothed, joined_.smoothed);
  append (rim.spacing, joined_.spacing);
  append (rim.is_partial, joined_.is_partial);
  append (rim.has_room, joined_.has_room);
  append (rim.open, joined_.open);
  CsrLists& lists = joined_.neighbors;
  if (lists.offsets.empty ())
    lists.offsets.push_back (0);
  const auto before = static_cast<Index> (lists.ids.size ());
  append (rim.neighbors.ids, lists.ids);
  for (std::size_t i = 1; i < rim.neighbors.offsets.size (); ++i)
    lists.offsets.push_back (before + rim.neighbors.offsets[i]);
  for (std::size_t i = 0; i < rim.others.size (); ++i)
    others_.push_back ({rim.others[i], rim.other_positions[i], rim.other_normals[i]});
  ++parts_;
}

void
RimJoiner::addTriangles (const PartRim& rim)
{
  const auto before = static_cast<Index> (points_.size ());
  std::vector<Index> last_of (rim.components, NONE); // a point of each component
  for (std::size_t t = 0; t < rim.triangles.size (); ++t) {
    const auto& [a, b, c] = rim.triangles[t];
    const Triangle corners{before + a, before + b, before + c};
    const Index component = rim.component[t];
    joined_.mesh.triangles.push_back (corners);
    joined_.origins.push_back ({{}, corners, parts_, rim.numbers[t], component});
    if (last_of[component] != NONE)
      joined_.same_side.push_back ({last_of[component], corners[0]});
    last_of[component] = corners[0];
  }
}

// Ascending, without repetition. They have triangles outside the rims: otherwise they would be
// free, and in the rim of their part.
std::vector<RimJoiner::Other>
RimJoiner::othersWithoutRim () const
{
  std::vector<Other> left;
  for (const Other& other : others_)
    if (!std::binary_search (points_.begin (), points_.end (), other.point))
      left.push_back (other);
  std::stable_sort (left.begin (), left.end (),
                    [] (const Other& a, const Other& b) { return a.point < b.point; });
  left.erase (std::unique (left.begin (), left.end (),
                           [] (const Other& a, const Other& b) { return a.point == b.point; }),
              left.end ());
  return left;
}

JoinedRims
RimJoiner::join (const RunContext& run) &&
{
  const std::vector<Other> others = othersWithoutRim ();
  others_ = {};
  const std::size_t count = points_.size () + others.size ();
  std::vector<Index> place (points_.size ()), all (count), other_places;
  for (std::size_t i = 0, o = 0; i < points_.size () || o < others.size ();) {
    const auto at = static_cast<Index> (i + o);
    if (o == others.size () || (i < points_.size () && points_[i] < others[o].point)) {
      place[i] = at;
      all[at] = points_[i++];
    }
    else {
      other_places.push_back (at);
      all[at] = others[o++].point;
    }
  }
  points_ = {};
  JoinedRims joined = std::move (joined_);
  joined.points = JoinedPoints (std::move (all));
  spread<Eigen::Vector3d> (place, count, Eigen::Vector3d::Zero (), joined.positions);
  spread<Eigen::Vector3f> (place, count, Eigen::Vector3f::Zero (), joined.normals);
  spread<Eigen::Vector3f> (place, count, Eigen::Vector3f::Zero (), joined.smoothed);
  spread (place, count, 0.0F, joined.spacing);
  spread<std::uint8_t> (place, count, 1, joined.is_partial);
  spread<std::uint8_t> (place, count, 0, joined.has_room);
  for (std::size_t o = 0; o < others.size (); ++o) {
    joined.positions[other_places[o]] = others[o].position;
    joined.normals[other_places[o]] = others[o].normal;
  }
  CsrLists& lists = joined.neighbors;
  std::vector<Index> lengths (count + 1, 0);
  for (std::size_t i = 0; i < place.size (); ++i)
    lengths[place[i] + 1] = static_cast<Index> (lists.row (i).size ());
  sumRowLengths (lengths);
  lists.offsets = std::move (lengths);
  for (Index& q : lists.ids)
    q = joined.points.placeOf (q);
  ProgressLoop progress (run);
  const auto move = [&place] (Index& p) { p = place[p]; };
  for (Triangle& corners : joined.mesh.triangles)
    std::for_each (corners.begin (), corners.end (), move);
  for (auto& pair : joined.same_side)
    std::for_each (pair.begin (), pair.end (), move);
  for (RimTriangle& origin : joined.origins) {
    progress.next ();
    std::for_each (origin.corners.begin (), origin.corners.end (), move);
    origin.ascending = origin.corners;
    std::sort (origin.ascending.begin (), origin.ascending.end ());
  }
  std::sort (joined.origins.begin (), joined.origins.end (),
             [] (const RimTriangle& a, const RimTriangle& b) { return a.ascending < b.ascending; });
  const auto hasNoRoom = [&joined] (Candidate& candidate) {
    return !std::all_of (candidate.corners.begin (), candidate.corners.end (), [&] (Index& p) {
      p = joined.points.placeOf (p);
      return p != NONE && joined.has_room[p] != 0;
    });
  };
  joined.open.erase (std::remove_if (joined.open.begin (), joined.open.end (), hasNoRoom),
                     joined.open.end ());
  joined.mesh.is_partial = joined.is_partial;
  joined.mesh.connect (joined.points.size (), run);
  return joined;
}

} // namespace pcl::floater
