// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/zone_splicing.h"

#include "core/disjoint_sets.h"
#include "mesh/piece_in_place.h"

#include <map>

namespace pcl::floater {
namespace {
// The points around by triangles, and the nearest ones.
void
addRings (const TriangleMesh& mesh, const CsrLists& neighbors, std::vector<Index>& points)
{
  std::vector<Index> wider = points;
  for (const Index p : points) {
    const Row around = neighbors.row (p);
    wider.insert (wider.end (), around.begin (), around.end ());
  }
  addRing (mesh, points);
  points.insert (points.end (), wider.begin (), wider.end ());
  sortUnique (points);
}

// Patches are connected by edges.
void
findPatches (const TriangleMesh& mesh, const std::vector<Index>& frame, Place& place)
{
  std::map<Index, Index> number;
  for (std::size_t i = 0; i < frame.size (); ++i)
    number[frame[i]] = static_cast<Index> (i);
  DisjointSets sets (frame.size ());
  for (std::size_t i = 0; i < frame.size (); ++i)
    for (const Index t : mesh.neighbors[frame[i]])
      if (const auto at = number.find (t); at != number.end ())
        sets.join (static_cast<Index> (i), at->second);
  place.patch_of = std::move (sets).number ([&place] (Index) {
    ++place.patches;
    return true;
  });
}

// Of each triangle, the zone that it goes for; or NONE. Of zones that have grown towards each other, the
// first ones are taken.
std::vector<Index>
zonesOf (const TriangleMesh& mesh, std::vector<std::optional<NewZone>>& made)
{
  std::vector<Index> zone_of (mesh.triangles.size (), NONE);
  std::vector<Index> zone_at (mesh.triangle_of.size (), NONE), gone, fan;
  for (Index zone = 0; zone < made.size (); ++zone) {
    if (!made[zone])
      continue;
    gone.clear ();
    for (const Index p : made[zone]->points) {
      mesh.fan (p, fan);
      gone.insert (gone.end (), fan.begin (), fan.end ());
    }
    const auto isTaken = [&] (Index t) {
      return anyCorner (mesh.triangles[t],
                        [&] (Index p) { return zone_at[p] != NONE && zone_at[p] != zone; });
    };
    if (std::any_of (gone.begin (), gone.end (), isTaken)) {
      made[zone].reset ();
      continue;
    }
    for (const Index t : gone) {
      zone_of[t] = zone;
      for (const Index p : mesh.triangles[t])
        zone_at[p] = zone;
    }
  }
  return zone_of;
}

} // namespace

std::vector<Triangle>
spliceZones (const TriangleMesh& mesh, std::vector<std::optional<NewZone>>& made)
{
  const std::size_t all = mesh.triangles.size ();
  const std::vector<Index> zone_of = zonesOf (mesh, made);
  const auto stays = [&] (Index t) { return zone_of[t] == NONE || !made[zone_of[t]]; };
  Flags is_turned (all + made.size (), 0); // of each triangle, and then of each zone
  // If the sides of a zone contradict others, that zone stays as it was, and the result is false.
  const auto turnPatches = [&] {
    SignedSets sets (is_turned.size ());
    for (Index t = 0; t < all; ++t)
      for (const Index u : mesh.neighbors[t])
        if (u != NONE && u < t && stays (t) && stays (u))
          sets.join (t, u, false);
    for (std::size_t zone = 0; zone < made.size (); ++zone)
      if (made[zone])
        for (const auto& [triangle, is_against] : made[zone]->patches)
          if (!sets.join (static_cast<Index> (all + zone), triangle, is_against)) {
            made[zone].reset ();
            return false;
          }
    // The side of most triangles stays the front.
    std::vector<std::array<std::size_t, 2>> votes (is_turned.size ());
    for (Index t = 0; t < all; ++t)
      if (stays (t)) {
        const SignedSets::Place at = sets.find (t);
        ++votes[at.root][at.flipped ? 1 : 0];
      }
    for (Index i = 0; i < is_turned.size (); ++i) {
      const SignedSets::Place at = sets.find (i);
      is_turned[i] = at.flipped != (votes[at.root][1] > votes[at.root][0]) ? 1 : 0;
    }
    return true;
  };
  const bool turns = std::any_of (made.begin (), made.end (), [] (const auto& zone) {
    return zone && std::any_of (zone->patches.begin (), zone->patches.end (),
                                [] (const auto& patch) { return patch.second; });
  });
  while (turns && !turnPatches ())
    ;
  std::vector<Triangle> triangles;
  for (Index t = 0; t < all; ++t)
    if (stays (t))
      triangles.push_back (turnedIf (is_turned[t] != 0, mesh.triangles[t]));
  for (std::size_t zone = 0; zone < made.size (); ++zone)
    if (made[zone])
      for (const Triangle& t : made[zone]->triangles)
        triangles.push_back (turnedIf (is_turned[all + zone] != 0, t));
  return triangles;
}

std::vector<std::optional<NewZone>>
placesOf (const TriangleMesh& other, const TriangleMesh& mesh, Flags& is_chosen)
{
  std::vector<Index> same; // of each triangle of the other mesh
  DisjointSets sets (is_chosen.size ());
  Flags is_changed (is_chosen.size (), 0), is_taken = is_changed;
  const auto join = [&sets] (const Triangle& t) {
    sets.join (t[0], t[1]);
    sets.join (t[1], t[2]);
  };
  const auto change = [&] (const Triangle& t) {
    join (t);
    is_changed[t[0]] = is_changed[t[1]] = is_changed[t[2]] = 1;
  };
  Flags stays (mesh.triangles.size (), 0);
  for (const Triangle& t : other.triangles)
    if (same.push_back (mesh.triangleWith (t)); same.back () != NONE)
      stays[same.back ()] = 1;
    else
      change (t);
  for (Index t = 0; t < stays.size (); ++t)
    if (stays[t] == 0)
      change (mesh.triangles[t]);
  for (Index p = 0; p < is_chosen.size (); ++p)
    if (is_chosen[p] != 0)
      is_taken[sets.find (p)] = 1;
  for (Index p = 0; p < is_chosen.size (); ++p)
    is_chosen[p] = is_changed[p] & is_taken[sets.find (p)];
  // Places whose triangles have a common corner are one zone.
  const auto isTaken = [&] (Index p) { return is_chosen[p] != 0; };
  for (const TriangleMesh* const one : {&mesh, &other})
    for (const Triangle& t : one->triangles)
      if (anyCorner (t, isTaken))
        join (t);
  std::map<Index, NewZone> zone_of;
  for (Index p = 0; p < is_chosen.size (); ++p)
    if (isTaken (p))
      zone_of[sets.find (p)].points.push_back (p);
  for (Index i = 0; i < same.size (); ++i) {
    const Triangle& t = other.triangles[i];
    if (!anyCorner (t, isTaken))
      continue;
    NewZone& zone = zone_of[sets.find (t[0])];
    zone.triangles.push_back (t);
    if (same[i] == NONE)
      continue;
    const Triangle& s = mesh.triangles[same[i]];
    for (const Index u : mesh.neighbors[same[i]])
      if (u != NONE && !anyCorner (mesh.triangles[u], isTaken))
        zone.patches.emplace_back (u, s[(mesh.sideOf (same[i], t[0]) + 1U) % 3] != t[1]);
  }
  std::vector<std::optional<NewZone>> zones;
  zones.reserve (zone_of.size ());
  for (auto& [first, zone] : zone_of)
    zones.emplace_back (std::move (zone));
  return zones;
}

PlaceOfMesh
placeOf (Row free, const TriangleMesh& mesh, const Positions& positions, const CsrLists& neighbors,
         const DisturbedZones& zones)
{
  PlaceOfMesh at;
  Place& place = at.place;
  std::vector<Index>& points = at.points; // ascending
  points.assign (free.begin (), free.end ());
  addRings (mesh, neighbors, points);
  addRings (mesh, neighbors, points);
  const auto inPlace = [&points] (Index p) { return placeIn (points, p); };
  place.is_free.assign (points.size (), 0);
  place.is_rim.assign (points.size (), 0);
  place.is_whole.assign (points.size (), 1);
  for (const Index p : free)
    place.is_free[inPlace (p)] = 1;
  std::vector<Index> fan;
  for (Index i = 0; i < points.size (); ++i) {
    place.positions.push_back (positions[points[i]]);
    place.is_boundary.push_back (place.is_free[i] == 0 ? zones.is_boundary[points[i]] : 0);
    mesh.fan (points[i], fan);
    for (const Index t : fan) {
      const Triangle& c = mesh.triangles[t];
      const Triangle local{inPlace (c[0]), inPlace (c[1]), inPlace (c[2])};
      const bool goes =
          anyCorner (local, [&] (Index p) { return p != NONE && place.is_free[p] != 0; });
      const bool stays = !goes && !isCorner (local, NONE) &&
                         !anyCorner (c, [&] (Index p) { return zones.is_free[p] != 0; });
      if (goes && place.is_free[i] == 0)
        place.is_rim[i] = 1;
      if (!goes && !stays)
        place.is_whole[i] = 0;
      if (*std::min_element (local.begin (), local.end ()) != i)
        continue;
      if (goes)
        at.old.push_back (local);
      if (stays) {
        at.frame.push_back (t);
        place.frame.push_back (local);
      }
    }
  }
  findPatches (mesh, at.frame, place);
  return at;
}

} // namespace pcl::floater
