// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/place_of_mesh.h"

#include "core/disjoint_sets.h"
#include "core/order_statistics.h"

#include <algorithm>
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
  place.patch_of = std::move (sets).number ([] (Index) { return true; });
  for (const Index patch : place.patch_of)
    place.patches = std::max (place.patches, patch + 1);
}

} // namespace

PlaceOfMesh
placeOf (Row free, const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
         const CsrLists& neighbors, const DisturbedZones& zones)
{
  PlaceOfMesh at;
  Place& place = at.place;
  std::vector<Index>& points = at.points; // ascending
  points.assign (free.begin (), free.end ());
  addRings (mesh, neighbors, points);
  addRings (mesh, neighbors, points);
  const auto inPlace = [&points] (Index p) {
    const auto found = std::lower_bound (points.begin (), points.end (), p);
    return found != points.end () && *found == p ? static_cast<Index> (found - points.begin ())
                                                 : NONE;
  };
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
