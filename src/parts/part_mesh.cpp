// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/part_mesh.h"

#include "consensus/consensus.h"
#include "consensus/manifold_part.h"

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

} // namespace pcl::floater
