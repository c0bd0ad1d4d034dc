// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/zone_splicing.h"

#include "core/disjoint_sets.h"
#include "core/order_statistics.h"
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

class ZoneSplicing
{
public:
  // Of zones that have grown towards each other, the first ones are taken.
  ZoneSplicing (const TriangleMesh& mesh, std::vector<std::optional<NewZone>>& made)
      : mesh_ (mesh), made_ (made), zone_of_ (mesh.triangles.size (), NONE)
  {
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
        zone_of_[t] = zone;
        for (const Index p : mesh.triangles[t])
          zone_at[p] = zone;
      }
    }
  }

  std::vector<Triangle> splice ()
  {
    const bool turns = std::any_of (made_.begin (), made_.end (), [] (const auto& zone) {
      return zone && std::any_of (zone->patches.begin (), zone->patches.end (),
                                  [] (const PatchSide& patch) { return patch.is_turned; });
    });
    is_turned_.assign (mesh_.triangles.size () + made_.size (), 0);
    while (turns && !turnPatches ())
      ;
    std::vector<Triangle> triangles;
    for (Index t = 0; t < mesh_.triangles.size (); ++t)
      if (stays (t))
        triangles.push_back (turnedIf (is_turned_[t] != 0, mesh_.triangles[t]));
    for (std::size_t zone = 0; zone < made_.size (); ++zone)
      if (made_[zone])
        for (const Triangle& t : made_[zone]->triangles)
          triangles.push_back (turnedIf (is_turned_[mesh_.triangles.size () + zone] != 0, t));
    return triangles;
  }

private:
  bool stays (Index t) const { return zone_of_[t] == NONE || !made_[zone_of_[t]]; }

  // Decides which triangles and zones are turned. If the sides of a zone contradict others, that
  // zone stays as it was, and the result is false.
  bool turnPatches ()
  {
    const std::size_t triangles = mesh_.triangles.size ();
    SignedSets sets (triangles + made_.size ());
    for (Index t = 0; t < triangles; ++t)
      for (const Index u : mesh_.neighbors[t])
        if (u != NONE && u < t && stays (t) && stays (u))
          sets.join (t, u, false);
    for (std::size_t zone = 0; zone < made_.size (); ++zone)
      if (made_[zone])
        for (const PatchSide& patch : made_[zone]->patches)
          if (!sets.join (static_cast<Index> (triangles + zone), patch.triangle, patch.is_turned)) {
            made_[zone].reset ();
            return false;
          }
    // The side of most triangles stays the front.
    std::vector<std::array<std::size_t, 2>> votes (is_turned_.size ());
    for (Index t = 0; t < triangles; ++t)
      if (stays (t)) {
        const SignedSets::Place at = sets.find (t);
        ++votes[at.root][at.flipped ? 1 : 0];
      }
    for (Index i = 0; i < is_turned_.size (); ++i) {
      const SignedSets::Place at = sets.find (i);
      is_turned_[i] = at.flipped != (votes[at.root][1] > votes[at.root][0]) ? 1 : 0;
    }
    return true;
  }

  const TriangleMesh& mesh_;
  std::vector<std::optional<NewZone>>& made_;
  std::vector<Index> zone_of_; // of each triangle, NONE if it has no free corner
  Flags is_turned_;            // of each triangle, and then of each zone
};

} // namespace

std::vector<Triangle>
spliceZones (const TriangleMesh& mesh, std::vector<std::optional<NewZone>>& made)
{
  return ZoneSplicing (mesh, made).splice ();
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
      const bool goes = std::any_of (local.begin (), local.end (),
                                     [&] (Index p) { return p != NONE && place.is_free[p] != 0; });
      const bool stays =
          !goes && *std::max_element (local.begin (), local.end ()) != NONE &&
          std::none_of (c.begin (), c.end (), [&] (Index p) { return zones.is_free[p] != 0; });
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
