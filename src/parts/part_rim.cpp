// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/part_rim.h"

#include "core/order_statistics.h"
#include "parts/mesh_region.h"

#include <algorithm>

namespace pcl::floater {
namespace {
// Rings behind a boundary that are needed to judge it (see findEvidence).
constexpr std::size_t BEHIND_BOUNDARY = 5;

// Of each triangle: 1 if its component has fewer triangles than `smallest`.
std::vector<std::uint8_t>
inSmallComponents (const PartMesh& mesh, std::size_t smallest)
{
  std::vector<std::size_t> size (mesh.components, 0);
  for (const Index c : mesh.component)
    ++size[c];
  std::vector<std::uint8_t> is_in (mesh.component.size ());
  for (std::size_t t = 0; t < is_in.size (); ++t)
    is_in[t] = size[mesh.component[t]] < smallest ? 1 : 0;
  return is_in;
}

// Adds points of the part to the region, without their triangles.
void
addPoints (std::vector<Index> more, MeshRegion& region)
{
  sortUnique (more);
  MeshRegion all;
  all.triangles = std::move (region.triangles);
  std::size_t i = 0;
  for (const Index p : more) {
    for (; i < region.points.size () && region.points[i] < p; ++i) {
      all.points.push_back (region.points[i]);
      all.is_partial.push_back (region.is_partial[i]);
    }
    if (i < region.points.size () && region.points[i] == p)
      continue;
    all.points.push_back (p);
    all.is_partial.push_back (1);
  }
  for (; i < region.points.size (); ++i) {
    all.points.push_back (region.points[i]);
    all.is_partial.push_back (region.is_partial[i]);
  }
  region = std::move (all);
}

} // namespace

PartRim
findRim (const PartPoints& points, const PartMesh& mesh, const NeighborRows& neighbors,
         const OtherPoints& others, std::size_t rings, std::size_t smallest)
{
  MeshRegion region = regionAround (mesh.triangles, points.size (), mesh.with_room, rings,
                                    inSmallComponents (mesh, smallest));
  // Points that may get to the boundary, where their neighbours are needed.
  std::vector<Index> with_row = regionAround (mesh.triangles, points.size (), mesh.with_room,
                                              rings - std::min (rings, BEHIND_BOUNDARY))
                                    .points;
  for (Index& p : with_row)
    p += points.first;
  const CsrLists rows = neighbors (with_row);
  PartRim rim;
  std::vector<Index> within; // neighbours in the part
  for (const Index q : rows.ids)
    if (points.has (q))
      within.push_back (q - points.first);
    else
      rim.others.push_back (q);
  addPoints (std::move (within), region);
  sortUnique (rim.others);
  others (rim.others, rim.other_positions, rim.other_normals);

  std::vector<Index> place (points.size (), NONE);
  auto room = mesh.with_room.begin ();
  auto of_row = with_row.begin ();
  rim.neighbors.offsets.push_back (0);
  for (std::size_t i = 0; i < region.points.size (); ++i) {
    const Index p = region.points[i];
    place[p] = static_cast<Index> (i);
    rim.points.push_back (points.first + p);
    rim.positions.push_back (points.positions[p]);
    rim.normals.push_back (points.normals[p]);
    rim.smoothed.push_back (mesh.smoothed[p]);
    rim.spacing.push_back (points.spacing[p]);
    const bool has_room = room != mesh.with_room.end () && *room == p;
    rim.has_room.push_back (has_room ? 1 : 0);
    room += has_room ? 1 : 0;
    if (of_row != with_row.end () && *of_row == points.first + p) {
      const Row row = rows.row (static_cast<std::size_t> (of_row - with_row.begin ()));
      rim.neighbors.ids.insert (rim.neighbors.ids.end (), row.begin (), row.end ());
      ++of_row;
    }
    rim.neighbors.offsets.push_back (static_cast<Index> (rim.neighbors.ids.size ()));
  }
  rim.is_partial = std::move (region.is_partial);
  for (const Index t : region.triangles) {
    const Triangle& corners = mesh.triangles[t];
    rim.triangles.push_back ({place[corners[0]], place[corners[1]], place[corners[2]]});
    rim.component.push_back (mesh.component[t]);
  }
  rim.numbers = std::move (region.triangles);
  rim.components = mesh.components;
  rim.open = mesh.open;
  return rim;
}

} // namespace pcl::floater
