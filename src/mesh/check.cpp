// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check.h"

#include "core/disjoint_sets.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/examination.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pcl::floater {
std::vector<float>
spacingOfMesh (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const RunContext& run)
{
  std::vector<float> spacing (positions.size (), 0.0F);
  parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Index> fan;
    std::vector<float> lengths;
    for (auto p = static_cast<Index> (first); p < last; ++p) {
      if (mesh.triangle_of[p] == NONE)
        continue;
      mesh.fan (p, fan);
      lengths.clear ();
      const auto add = [&] (Index q) {
        lengths.push_back (static_cast<float> ((positions[q] - positions[p]).norm ()));
      };
      for (const Index t : fan)
        add (mesh.triangles[t][TriangleMesh::next (mesh.sideOf (t, p))]);
      add (mesh.triangles[fan.back ()][TriangleMesh::previous (mesh.sideOf (fan.back (), p))]);
      spacing[p] = median (lengths);
    }
  });
  std::vector<float> known;
  std::copy_if (spacing.begin (), spacing.end (), std::back_inserter (known),
                [] (float value) { return value > 0.0F; });
  if (!known.empty ())
    std::replace (spacing.begin (), spacing.end (), 0.0F, median (known));
  return spacing;
}

namespace {
void
noteImproper (const std::vector<Triangle>& triangles, std::size_t points, Surroundings& around)
{
  for (const Triangle& t : triangles) {
    if (isProper (t, points))
      continue;
    ++around.nonmanifold_edges;
    ++around.degenerate_triangles;
    for (const Index p : t)
      if (p < points)
        around.broken_at = std::min (around.broken_at, p);
  }
}

std::size_t
countComponentsByEdges (const std::vector<Triangle>& triangles, std::size_t points)
{
  std::vector<std::array<Index, 3>> edges; // smaller end, larger end, triangle
  std::size_t count = 0;
  for (Index t = 0; t < triangles.size (); ++t)
    if (isProper (triangles[t], points)) {
      ++count;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [a, b] = std::minmax (triangles[t][i], triangles[t][(i + 1) % 3]);
        edges.push_back ({a, b, t});
      }
    }
  std::sort (edges.begin (), edges.end ());
  DisjointSets components (triangles.size ());
  for (std::size_t e = 1; e < edges.size (); ++e)
    if (edges[e][0] == edges[e - 1][0] && edges[e][1] == edges[e - 1][1])
      count -= components.join (edges[e - 1][2], edges[e][2]) ? 1 : 0;
  return count;
}

// Numbers the components by vertices. They equal those by edges unless a vertex has several fans.
// \return the component of each point, NONE if it is unused
std::vector<Index>
numberComponents (DisjointSets sets, ExaminedParts& parts)
{
  auto unused = parts.around.unused.begin ();
  const auto end = parts.around.unused.end ();
  std::vector<Index> component = std::move (sets).number ([&] (Index p) {
    while (unused != end && *unused < p)
      ++unused;
    if (unused != end && *unused == p)
      return false;
    parts.component_first.push_back (p);
    return true;
  });
  parts.component_points.assign (parts.component_first.size (), 0);
  for (const Index c : component)
    if (c != NONE)
      ++parts.component_points[c];
  return component;
}

} // namespace

MeshExamination
checkMesh (const std::vector<Triangle>& triangles, const Points& points,
           const std::vector<float>& spacing, const RunContext& run, const CheckLimits& limits)
{
  const ExaminedMesh mesh{triangles, points.positions, spacing, points.diagonal};
  ExaminedParts parts;
  DisjointSets sets (points.size ()); // of points, joined along edges
  {
    const TriangleRanges ranges (triangles, points.size (), run);
    parts.around = lookAround (mesh, ranges, limits, sets, run);
    parts.triangles = triangles.size () - ranges.leftOut ();
  }
  if (parts.triangles < triangles.size ())
    noteImproper (triangles, points.size (), parts.around);
  const std::vector<Index> component = numberComponents (std::move (sets), parts);
  parts.components = parts.around.nonmanifold_vertices > 0
                         ? countComponentsByEdges (triangles, points.size ())
                         : parts.component_points.size ();
  return makeExamination (std::move (parts), mesh, component, points);
}

void
checkCrossing (const std::vector<Triangle>& triangles, const Points& points, const RunContext& run,
               MeshExamination& found, std::optional<CrossingPairs> known)
{
  constexpr std::size_t PLACES = 10; // as in MeshCheck
  if (!found.isManifold ())
    return;
  found.crossing =
      known ? std::move (*known) : findSelfIntersections (triangles, points.positions, run);
  found.check.self_intersections = found.crossing.size ();
  found.check.has_more_self_intersections = !found.crossing.untested.empty ();
  if (!found.crossing.untested.empty ())
    found.crossing_at = triangles[found.crossing.untested.front ()][0];
  for (const CrossingPair& pair : found.crossing) {
    const Index at = triangles[pair.first][0], other_at = triangles[pair.second][0];
    if (found.check.self_intersections_at.size () < PLACES)
      found.check.self_intersections_at.push_back (
          {points.cloud_index[at], points.cloud_index[other_at]});
    found.crossing_at = std::min ({found.crossing_at, at, other_at});
  }
}

} // namespace pcl::floater
