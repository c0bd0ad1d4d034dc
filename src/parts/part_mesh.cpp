// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/part_mesh.h"

#include "consensus/consensus.h"
#include "consensus/manifold_part.h"
#include "core/order_statistics.h"
#include "parts/near_triangles.h"

#include <algorithm>
#include <utility>

namespace pcl::floater {
PartCandidates
divideCandidates (CandidateLists of_part, Index first, Index last,
                  const std::vector<std::uint8_t>& reaches_out)
{
  const auto isInside = [&] (const Triangle& corners) {
    return std::all_of (corners.begin (), corners.end (),
                        [&] (Index p) { return p >= first && p < last; });
  };
  const auto reachesOutAt = [&] (Index p) { return reaches_out[p - first] != 0; };
  PartCandidates divided;
  // In place: kept entries move forwards in their list.
  const auto divide = [&] (auto& list, const auto& isKept, const auto& asLeft) {
    std::size_t kept = 0;
    for (const auto& candidate : list) {
      if (!isKept (candidate.corners)) {
        divided.left.push_back (asLeft (candidate));
        continue;
      }
      list[kept] = candidate;
      for (Index& p : list[kept++].corners)
        p -= first;
    }
    list.resize (kept);
  };
  divide (of_part.sure, isInside, [] (const SureTriangle& sure) {
    return Candidate{sure.corners, 3, 0, 0.0F, 0.0F};
  });
  divide (
      of_part.doubtful,
      [&] (const Triangle& corners) {
        return isInside (corners) && std::none_of (corners.begin (), corners.end (), reachesOutAt);
      },
      [] (const Candidate& doubtful) { return doubtful; });
  divided.inside = std::move (of_part);
  return divided;
}

std::vector<std::uint8_t>
reachesOut (const CsrLists& stars, Index first, const Parts& parts)
{
  std::vector<std::uint8_t> reaches (stars.rows ());
  Index part_first = 0, part_last = 0;
  for (std::size_t r = 0; r < reaches.size (); ++r) {
    const auto p = static_cast<Index> (first + r);
    if (p >= part_last) {
      const std::size_t part = parts.partOf (p);
      part_first = parts.first (part);
      part_last = parts.last (part);
    }
    const Row row = stars.row (r);
    reaches[r] = std::any_of (row.begin (), row.end (),
                              [&] (Index q) { return q < part_first || q >= part_last; })
                     ? 1
                     : 0;
  }
  return reaches;
}

namespace {
std::vector<Index>
findRoom (const TriangleMesh& mesh)
{
  std::vector<std::uint8_t> has_room (mesh.triangle_of.size (), 0);
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] == NONE)
        has_room[mesh.from ({t, side})] = has_room[mesh.to ({t, side})] = 1;
  std::vector<Index> points;
  for (Index p = 0; p < has_room.size (); ++p)
    if (has_room[p] != 0 || mesh.triangle_of[p] == NONE)
      points.push_back (p);
  return points;
}

// Appends the free candidates to `open`.
void
appendOpen (const CandidateLists& inside, const std::vector<Index>& with_room, Index first,
            std::size_t points, std::vector<Candidate>& open)
{
  std::vector<std::uint8_t> has_room (points, 0);
  for (const Index p : with_room)
    has_room[p] = 1;
  const auto offer = [&] (Candidate candidate) {
    Triangle& corners = candidate.corners;
    if (!std::all_of (corners.begin (), corners.end (), [&] (Index p) { return has_room[p] != 0; }))
      return;
    for (Index& p : corners)
      p += first;
    open.push_back (candidate);
  };
  for (const SureTriangle& sure : inside.sure)
    offer ({sure.corners, 3, 0, 0.0F, 0.0F});
  for (const Candidate& doubtful : inside.doubtful)
    offer (doubtful);
}

} // namespace

PartMesh
makePartMesh (const PartPoints& points, std::vector<Eigen::Vector3f> smoothed,
              PartCandidates candidates, const NeighborRows& neighbors,
              const ConsensusLimits& limits, const RunContext& run)
{
  std::vector<Index> row;
  const auto neighborsWithin = [&] (Index p) {
    row.clear ();
    for (const Index q : neighbors ({points.first + p}).ids)
      if (points.has (q))
        row.push_back (q - points.first);
    return Row{row.data (), row.data () + row.size ()};
  };
  PartMesh part;
  part.smoothed = std::move (smoothed);
  TriangleMesh mesh =
      *manifoldPart (buildConsensus (points.positions, candidates.inside, part.smoothed, run),
                     points.size (), neighborsWithin, limits.smallest_island, {}, run);
  MeshComponents components = findComponents (mesh, run);
  part.with_room = findRoom (mesh);
  part.open = std::move (candidates.left);
  appendOpen (candidates.inside, part.with_room, points.first, points.size (), part.open);
  part.triangles = std::move (mesh.triangles);
  part.component = std::move (components.of_triangle);
  part.components = components.count;
  return part;
}

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
