// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/examination.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl::floater {
namespace {
// Connects boundary edges to cycles. Where the mesh is no manifold, a walk ends at a point without
// an outgoing edge.
std::vector<BoundaryLoop>
walkLoops (const std::vector<BoundaryEdge>& edges)
{
  std::vector<BoundaryLoop> loops;
  std::vector<std::uint8_t> walked (edges.size (), 0);
  for (std::size_t start = 0; start < edges.size (); ++start) {
    if (walked[start] != 0)
      continue;
    BoundaryLoop loop;
    for (std::size_t e = start; e < edges.size () && walked[e] == 0;) {
      walked[e] = 1;
      loop.points.push_back (edges[e].first);
      const Index to = edges[e].second;
      e = static_cast<std::size_t> (
          std::lower_bound (edges.begin (), edges.end (), BoundaryEdge{to, 0}) - edges.begin ());
      while (e < edges.size () && edges[e].first == to && walked[e] != 0)
        ++e;
      if (e < edges.size () && edges[e].first != to)
        break;
    }
    loops.push_back (std::move (loop));
  }
  return loops;
}

LoopSummary
summaryOf (const BoundaryLoop& loop, const Points& points)
{
  LoopSummary summary;
  summary.points = loop.points.size ();
  // The sum may overflow although all coordinates are finite.
  summary.length = std::min (points.scale * loop.length, std::numeric_limits<double>::max ());
  summary.width = points.scale * loop.width;
  summary.width_spacings = loop.spacing > 0.0 ? loop.width / loop.spacing : 0.0;
  summary.at = NONE;
  for (const Index p : loop.points)
    summary.at = std::min (summary.at, points.cloud_index[p]);
  return summary;
}

// Longest first; equal lengths by their smallest points.
void
sortLoops (MeshExamination& found)
{
  std::vector<std::size_t> order (found.loops.size ());
  std::iota (order.begin (), order.end (), std::size_t{0});
  const std::vector<LoopSummary>& loops = found.check.loops;
  std::sort (order.begin (), order.end (), [&loops] (std::size_t a, std::size_t b) {
    return loops[a].length != loops[b].length ? loops[a].length > loops[b].length
                                              : loops[a].at < loops[b].at;
  });
  std::vector<LoopSummary> sorted_summaries;
  std::vector<BoundaryLoop> sorted_loops;
  for (const std::size_t i : order) {
    sorted_summaries.push_back (loops[i]);
    sorted_loops.push_back (std::move (found.loops[i]));
  }
  found.check.loops = std::move (sorted_summaries);
  found.loops = std::move (sorted_loops);
}

void
takeSurroundings (const Surroundings& around, std::size_t triangles, const Points& points,
                  MeshExamination& found)
{
  MeshCheck& check = found.check;
  check.nonmanifold_vertices = around.nonmanifold_vertices;
  check.nonmanifold_edges = around.nonmanifold_edges;
  check.orientation_conflicts = around.orientation_conflicts;
  check.degenerate_triangles = around.degenerate_triangles;
  check.folds = around.folds;
  check.euler_characteristic = static_cast<std::int64_t> (points.size () - around.unused.size ()) -
                               static_cast<std::int64_t> (around.edges) +
                               static_cast<std::int64_t> (triangles);
  check.longest_edge = std::sqrt (around.sqr_longest);
  const auto [a, b] = around.longest_at;
  if (around.sqr_longest > 0.0)
    check.longest_edge_at = {points.cloud_index[a], points.cloud_index[b]};
  found.longest_inside = std::sqrt (around.sqr_longest_inside);
  found.longest_inside_at = around.longest_inside_at;
  found.long_edges = around.long_edges;
  found.broken_at = around.broken_at;
  found.fold_at = around.fold_at;
  found.degenerate_at = around.degenerate_at;
}

void
takeComponents (ExaminedParts&& parts, MeshExamination& found)
{
  found.check.components = parts.components;
  found.component_points = std::move (parts.component_points);
  const std::vector<std::size_t>& counts = found.component_points;
  for (std::size_t c = 0; c < counts.size (); ++c) {
    found.largest_component = std::max (found.largest_component, counts[c]);
    if (c == 0 || counts[c] < found.smallest_component) {
      found.smallest_component = counts[c];
      found.smallest_component_at = parts.component_first[c];
    }
  }
}

} // namespace

MeshExamination
makeExamination (ExaminedParts parts, const ExaminedMesh& mesh,
                 const std::function<Index (Index)>& pointOf, const std::vector<Index>& component,
                 const Points& points)
{
  MeshExamination found;
  found.check.done = true;
  takeSurroundings (parts.around, parts.triangles, points, found);
  found.unused = std::move (parts.around.unused);
  found.loops = walkLoops (parts.around.boundary);
  takeComponents (std::move (parts), found);
  for (BoundaryLoop& loop : found.loops) {
    measureLoop (loop, mesh.positions, mesh.spacing);
    loop.component = component[loop.points.front ()];
    for (Index& p : loop.points)
      p = pointOf (p);
    found.check.loops.push_back (summaryOf (loop, points));
  }
  sortLoops (found);
  // The Euler characteristic of a component is 2 - 2 genus - loops.
  if (found.isManifold ())
    found.check.genus =
        (2 * static_cast<std::int64_t> (found.check.components) -
         static_cast<std::int64_t> (found.loops.size ()) - found.check.euler_characteristic) /
        2;
  return found;
}

} // namespace pcl::floater
