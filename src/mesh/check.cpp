// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check.h"

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "mesh/surroundings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl
{
namespace floater
{
namespace
{
class Examiner
{
public:
  Examiner (const std::vector<Triangle>& triangles, const Points& points,
            const std::vector<float>& spacing, const RunContext& run, const CheckLimits& limits,
            MeshExamination& found)
      : triangles_ (triangles), points_ (points), spacing_ (spacing), run_ (run), limits_ (limits),
        found_ (found), check_ (found.check)
  {
  }

  // Looks at the triangles and edges around every point, then counts components.
  void examine ()
  {
    const std::size_t points = points_.positions.size ();
    DisjointSets sets (points); // of points that are connected by edges
    std::size_t proper = triangles_.size ();
    const Surroundings all = lookAround (sets, proper);
    check_.nonmanifold_vertices = all.nonmanifold_vertices;
    check_.nonmanifold_edges += all.nonmanifold_edges;
    check_.orientation_conflicts = all.orientation_conflicts;
    check_.degenerate_triangles += all.degenerate_triangles;
    check_.folds = all.folds;
    check_.euler_characteristic = static_cast<std::int64_t> (points - all.unused.size ()) -
                                  static_cast<std::int64_t> (all.edges) +
                                  static_cast<std::int64_t> (proper);
    check_.longest_edge = std::sqrt (all.sqr_longest);
    const auto [a, b] = all.longest_at;
    if (all.sqr_longest > 0.0)
      check_.longest_edge_at = {points_.cloud_index[a], points_.cloud_index[b]};
    found_.longest_inside = std::sqrt (all.sqr_longest_inside);
    found_.longest_inside_at = all.longest_inside_at;
    found_.long_edges = all.long_edges;
    found_.broken_at = std::min (found_.broken_at, all.broken_at);
    found_.fold_at = all.fold_at;
    found_.degenerate_at = all.degenerate_at;
    found_.unused = all.unused;
    boundary_ = all.boundary;
    countComponents (std::move (sets));
  }

  // Sorted by the points from which they lead.
  const std::vector<BoundaryEdge>& boundary () const { return boundary_; }

  Index componentOf (Index p) const { return component_[p]; }

private:
  // \param proper set to the number of proper triangles
  Surroundings lookAround (DisjointSets& sets, std::size_t& proper)
  {
    const TriangleRanges ranges (triangles_, points_.size (), run_);
    proper -= ranges.leftOut ();
    if (ranges.leftOut () > 0)
      noteImproper ();
    std::vector<Surroundings> parts (ranges.count ());
    parallelTasks (run_, ranges.count (), [&] (std::size_t r) {
      SurroundingsCheck check (triangles_, points_, spacing_, limits_, sets);
      parts[r] = check.lookAround (ranges, r, run_);
    });
    Surroundings all;
    ProgressLoop progress (run_);
    for (Surroundings& part : parts) {
      for (const auto& [p, q] : part.leaving) {
        progress.next ();
        sets.join (p, q);
      }
      all.append (std::move (part));
    }
    return all;
  }

  void noteImproper ()
  {
    const std::size_t points = points_.size ();
    for (const Triangle& t : triangles_) {
      if (isProper (t, points))
        continue;
      ++check_.nonmanifold_edges;
      ++check_.degenerate_triangles;
      for (const Index p : t)
        if (p < points)
          found_.broken_at = std::min (found_.broken_at, p);
    }
  }

  // Components by vertices. They are those by edges unless a vertex has several fans.
  void countComponents (DisjointSets sets)
  {
    std::vector<Index> first_points; // of each component
    auto unused = found_.unused.begin ();
    component_ = std::move (sets).number ([&] (Index p) {
      while (unused != found_.unused.end () && *unused < p)
        ++unused;
      if (unused != found_.unused.end () && *unused == p)
        return false;
      first_points.push_back (p);
      return true;
    });
    std::vector<std::size_t>& counts = found_.component_points;
    counts.assign (first_points.size (), 0);
    for (const Index c : component_)
      if (c != NONE)
        ++counts[c];
    for (Index c = 0; c < counts.size (); ++c) {
      found_.largest_component = std::max (found_.largest_component, counts[c]);
      if (c == 0 || counts[c] < found_.smallest_component) {
        found_.smallest_component = counts[c];
        found_.smallest_component_at = first_points[c];
      }
    }
    check_.components = check_.nonmanifold_vertices > 0 ? componentsByEdges () : counts.size ();
  }

  std::size_t componentsByEdges () const
  {
    std::vector<std::array<Index, 3>> edges; // smaller end, larger end, triangle
    std::size_t count = 0;
    for (Index t = 0; t < triangles_.size (); ++t)
      if (isProper (triangles_[t], points_.positions.size ())) {
        ++count;
        for (std::size_t i = 0; i < 3; ++i) {
          const auto [a, b] = std::minmax (triangles_[t][i], triangles_[t][(i + 1) % 3]);
          edges.push_back ({a, b, t});
        }
      }
    std::sort (edges.begin (), edges.end ());
    DisjointSets components (triangles_.size ());
    for (std::size_t e = 1; e < edges.size (); ++e)
      if (edges[e][0] == edges[e - 1][0] && edges[e][1] == edges[e - 1][1])
        count -= components.join (edges[e - 1][2], edges[e][2]) ? 1 : 0;
    return count;
  }

  const std::vector<Triangle>& triangles_;
  const Points& points_;
  const std::vector<float>& spacing_;
  RunContext run_;
  CheckLimits limits_;
  MeshExamination& found_;
  MeshCheck& check_;
  std::vector<Index> component_; // of each point, NONE if it is not used
  std::vector<BoundaryEdge> boundary_;
};

// Boundary edges in cycles. Where the mesh is no manifold, a walk ends at a point that no edge
// leaves.
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
  // A sum of edges may exceed what a double holds where no coordinate does.
  summary.length = std::min (points.scale * loop.length, std::numeric_limits<double>::max ());
  summary.width = points.scale * loop.width;
  summary.width_spacings = loop.spacing > 0.0 ? loop.width / loop.spacing : 0.0;
  summary.at = NONE;
  for (const Index p : loop.points)
    summary.at = std::min (summary.at, points.cloud_index[p]);
  return summary;
}

// Longest first, those of equal length by their place.
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

} // namespace

MeshExamination
checkMesh (const std::vector<Triangle>& triangles, const Points& points,
           const std::vector<float>& spacing, const RunContext& run, const CheckLimits& limits)
{
  MeshExamination found;
  found.check.done = true;
  Examiner examiner (triangles, points, spacing, run, limits, found);
  examiner.examine ();
  found.loops = walkLoops (examiner.boundary ());
  for (BoundaryLoop& loop : found.loops) {
    measureLoop (loop, points.positions, spacing);
    loop.component = examiner.componentOf (loop.points.front ());
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

void
checkCrossing (const std::vector<Triangle>& triangles, const Points& points, const RunContext& run,
               MeshExamination& found, const CrossingSearch& search)
{
  constexpr std::size_t PLACES = 10; // as in MeshCheck
  if (!found.isManifold ())
    return;
  found.crossing = search ? search (triangles, points, run)
                          : findSelfIntersections (triangles, points.positions, run);
  found.check.self_intersections = found.crossing.size ();
  for (const CrossingPair& pair : found.crossing) {
    const Index at = triangles[pair.first][0], other_at = triangles[pair.second][0];
    if (found.check.self_intersections_at.size () < PLACES)
      found.check.self_intersections_at.push_back (
          {points.cloud_index[at], points.cloud_index[other_at]});
    found.crossing_at = std::min ({found.crossing_at, at, other_at});
  }
}

} // namespace floater
} // namespace pcl
