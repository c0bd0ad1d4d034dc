// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/seam_finish.h"

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "parts/joined_rims.h"
#include "parts/near_triangles.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pcl::floater {
SeamComponents
joinComponents (const JoinedPoints& points, const TriangleMesh& mesh, std::size_t seam,
                const NearTriangles& near, const std::vector<InnerCheck>& checks)
{
  // Elements of the sets: the points, then the components of all parts.
  std::vector<Index> begins (1, static_cast<Index> (points.size ()));
  for (const InnerCheck& check : checks)
    begins.push_back (begins.back () + static_cast<Index> (check.components.size ()));
  DisjointSets sets (begins.back ());
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
    const Triangle& corners = mesh.triangles[t];
    if (t < seam) {
      sets.join (corners[0], corners[1]);
      sets.join (corners[0], corners[2]);
      continue;
    }
    const Index component = near.component[t - seam];
    if (component == NONE)
      continue;
    for (const Index p : corners)
      if (!mesh.isPartial (p))
        sets.join (p, begins[near.part[t - seam]] + component);
  }
  const auto isUsed = [&mesh] (Index p) {
    return !mesh.isPartial (p) && mesh.triangle_of[p] != NONE;
  };

  // The smallest point of each set, by its representative.
  std::vector<Index> first (begins.back (), NONE);
  const auto note = [&] (Index element, Index point) {
    Index& smallest = first[sets.find (element)];
    smallest = std::min (smallest, point);
  };
  for (Index p = 0; p < points.size (); ++p)
    if (isUsed (p))
      note (p, points.pointAt (p));
  for (std::size_t part = 0; part < checks.size (); ++part)
    for (Index c = 0; c < checks[part].components.size (); ++c)
      note (begins[part] + c, checks[part].components[c].sum.sum.at);
  std::vector<std::pair<Index, Index>> roots; // by their smallest points
  for (Index element = 0; element < first.size (); ++element)
    if (first[element] != NONE)
      roots.emplace_back (first[element], element);
  std::sort (roots.begin (), roots.end ());

  SeamComponents components;
  std::vector<Index> number (begins.back (), NONE); // of each root
  for (const auto& [smallest, root] : roots) {
    number[root] = static_cast<Index> (components.first.size ());
    components.first.push_back (smallest);
  }
  components.points.assign (components.first.size (), 0);
  components.of_point.assign (points.size (), NONE);
  for (Index p = 0; p < points.size (); ++p)
    if (isUsed (p))
      ++components.points[components.of_point[p] = number[sets.find (p)]];
  for (std::size_t part = 0; part < checks.size (); ++part) {
    std::vector<Index>& of_part = components.of_inner.emplace_back ();
    for (Index c = 0; c < checks[part].components.size (); ++c) {
      of_part.push_back (number[sets.find (begins[part] + c)]);
      components.points[of_part.back ()] += checks[part].components[c].points;
    }
  }
  return components;
}

namespace {
// Converts neighbours to indices of the zones; drops others.
void
toPlaces (const JoinedPoints& points, CsrLists& lists, const RunContext& run)
{
  parallelRanges (run, lists.ids.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      lists.ids[i] = points.placeOf (lists.ids[i]);
  });
  CsrLists within;
  within.ids.reserve (lists.ids.size ());
  within.offsets.reserve (lists.offsets.size ());
  within.offsets.push_back (0);
  for (std::size_t r = 0; r < lists.rows (); ++r) {
    for (const Index place : lists.row (r))
      if (place != NONE)
        within.ids.push_back (place);
    within.offsets.push_back (static_cast<Index> (within.ids.size ()));
  }
  lists = std::move (within);
}

// Triangles that are not repaired: those far from triangles with corners in several parts and from
// neighbours of points without a triangle, and those at edges between partial points without a
// triangle on the other side, which may be outside the zones.
std::vector<std::uint8_t>
findFixed (const TriangleMesh& mesh, const CsrLists& neighbors, std::size_t first_of_seam,
           std::size_t rings)
{
  std::vector<Index> seeds;
  for (std::size_t t = first_of_seam; t < mesh.triangles.size (); ++t)
    seeds.insert (seeds.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
  for (Index p = 0; p < mesh.triangle_of.size (); ++p)
    if (mesh.triangle_of[p] == NONE) {
      const Row row = neighbors.row (p);
      seeds.insert (seeds.end (), row.begin (), row.end ());
    }
  std::vector<std::uint8_t> is_fixed (mesh.triangles.size (), 1);
  for (const Index t :
       regionAround (mesh.triangles, mesh.triangle_of.size (), seeds, rings).triangles)
    is_fixed[t] = 0;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] == NONE && mesh.isPartial (mesh.from ({t, side})) &&
          mesh.isPartial (mesh.to ({t, side})))
        is_fixed[t] = 1;
  return is_fixed;
}

} // namespace

void
JoinedZones::add (const SeamZone& zone)
{
  const auto before = static_cast<Index> (points.size ());
  const auto append = [] (const auto& values, auto& all) {
    all.insert (all.end (), values.begin (), values.end ());
  };
  append (zone.points, points);
  append (zone.positions, positions);
  append (zone.normals, normals);
  append (zone.spacing, spacing);
  append (zone.is_partial, is_partial);
  if (neighbors.offsets.empty ())
    neighbors.offsets.push_back (0);
  const auto entries = static_cast<Index> (neighbors.ids.size ());
  append (zone.neighbors.ids, neighbors.ids);
  for (std::size_t i = 0; i < zone.points.size (); ++i)
    neighbors.offsets.push_back (entries + zone.neighbors.offsets[i + 1]);
  for (const auto& [a, b, c] : zone.triangles)
    triangles.push_back ({before + a, before + b, before + c});
}

FinishedSeam
finishSeam (JoinedZones zones, const std::vector<Triangle>& seam, std::vector<double> corners,
            const FinishSettings& settings, std::size_t rings, const RunContext& run)
{
  const JoinedPoints points (zones.points);
  toPlaces (points, zones.neighbors, run);
  TriangleMesh mesh; // the seam comes last
  mesh.triangles = std::move (zones.triangles);
  mesh.is_partial = std::move (zones.is_partial);
  const std::size_t first_of_seam = mesh.triangles.size ();
  for (const auto& [a, b, c] : seam)
    mesh.triangles.push_back ({points.placeOf (a), points.placeOf (b), points.placeOf (c)});
  if (!mesh.connect (points.size (), run))
    throw std::logic_error ("the triangles between parts do not fit");
  mesh.is_fixed = findFixed (mesh, zones.neighbors, first_of_seam, rings);
  std::size_t folds_of_parts = 0; // already reported by the parts
  for (const MeshEdge& e : findFolds (mesh, zones.positions, run))
    folds_of_parts += std::max (e.triangle, mesh.mate (e).triangle) < first_of_seam ? 1 : 0;
  FinishedSeam finished;
  MeshFinish& finish = finished.finish;
  finish = repairMesh (mesh, {zones.positions, zones.neighbors, zones.spacing, zones.normals},
                       settings, run);
  finish.folds_after_flips -= std::min (finish.folds_after_flips, folds_of_parts);
  mesh.is_fixed.clear ();
  if (settings.open_boundary)
    openBoundary (mesh, zones.positions, std::move (corners), settings.limits.notches, run, finish);
  finished.triangles = std::move (mesh.triangles);
  finished.zones = std::move (zones);
  return finished;
}

} // namespace pcl::floater
