// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check.h"

#include "core/csr_lists.h"
#include "core/disjoint_sets.h"
#include "core/geometry.h"

#include <Eigen/Geometry>

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
using BoundaryEdge = std::pair<Index, Index>; // from, to: the surface on the left

bool
isProper (const Triangle& t, std::size_t points)
{
  return t[0] < points && t[1] < points && t[2] < points && t[0] != t[1] && t[1] != t[2] &&
         t[2] != t[0];
}

class Examiner
{
public:
  Examiner (const std::vector<Triangle>& triangles, const Points& points,
            const std::vector<float>& spacing, const RunContext& run, const CheckLimits& limits,
            MeshExamination& found)
      : triangles_ (triangles), points_ (points), spacing_ (spacing), run_ (run), limits_ (limits),
        found_ (found), check_ (found.check), sets_ (points.size ()), slot_ (points.size (), NONE)
  {
  }

  // Looks at the triangles and edges around every point, then counts components.
  void examine ()
  {
    const std::size_t points = points_.positions.size ();
    indexCorners ();
    ProgressLoop progress (run_, points);
    for (Index p = 0; p < points; ++p) {
      progress.next ();
      if (triangles_at_.row (p).size () == 0)
        found_.unused.push_back (p);
      else
        lookAround (p);
    }
    check_.euler_characteristic = static_cast<std::int64_t> (points - found_.unused.size ()) -
                                  static_cast<std::int64_t> (edges_) +
                                  static_cast<std::int64_t> (triangles_at_.ids.size () / 3);
    check_.longest_edge = std::sqrt (sqr_longest_);
    found_.longest_inside = std::sqrt (sqr_longest_inside_);
    std::vector<Index> ().swap (triangles_at_.ids); // the offsets are still needed
    countComponents ();
  }

  // Sorted.
  const std::vector<BoundaryEdge>& boundary () const { return boundary_; }

  Index componentOf (Index p) { return component_[sets_.find (p)]; }

private:
  // An edge from the current point, and the triangles at it.
  struct Spoke
  {
    Index to;
    Index out = 0, in = 0;           // triangles that run along it from the point, and to the point
    Index left = NONE, right = NONE; // third corners of an outgoing and of an incoming triangle
    Index fan;                       // disjoint sets: another spoke of the same fan, or itself
  };

  void indexCorners ()
  {
    const std::size_t points = points_.size ();
    ProgressLoop progress (run_);
    for (const Triangle& t : triangles_) {
      progress.next ();
      if (!isProper (t, points))
        noteImproper (t);
    }
    triangles_at_ = makeCsrLists (points, [&] (const auto& emit) {
      for (Index t = 0; t < triangles_.size (); ++t)
        if (isProper (triangles_[t], points))
          for (const Index p : triangles_[t])
            emit (p, t);
    });
  }

  void noteImproper (const Triangle& t)
  {
    ++check_.nonmanifold_edges;
    ++check_.degenerate_triangles;
    for (const Index p : t)
      if (p < points_.positions.size ())
        note (found_.broken_at, p);
  }

  static void note (Index& place, Index p) { place = std::min (place, p); }

  Index spokeTo (Index q)
  {
    if (slot_[q] == NONE) {
      slot_[q] = static_cast<Index> (spokes_.size ());
      spokes_.push_back ({q, 0, 0, NONE, NONE, slot_[q]});
    }
    return slot_[q];
  }

  Index fanOf (Index spoke)
  {
    while (spokes_[spoke].fan != spoke)
      spoke = spokes_[spoke].fan = spokes_[spokes_[spoke].fan].fan;
    return spoke;
  }

  void lookAround (Index p)
  {
    spokes_.clear ();
    std::size_t joins = 0;
    for (const Index triangle : triangles_at_.row (p)) {
      const Triangle& t = triangles_[triangle];
      const std::size_t side = t[0] == p ? 0 : t[1] == p ? 1 : 2;
      const Index q = t[side == 2 ? 0 : side + 1], r = t[side == 0 ? 2 : side - 1];
      if (p < q && p < r)
        lookAtTriangle (p, q, r);
      const Index a = spokeTo (q), b = spokeTo (r);
      ++spokes_[a].out;
      spokes_[a].left = r;
      ++spokes_[b].in;
      spokes_[b].right = q;
      const Index fan_a = fanOf (a), fan_b = fanOf (b);
      joins += fan_a != fan_b ? 1 : 0;
      spokes_[std::max (fan_a, fan_b)].fan = std::min (fan_a, fan_b);
    }
    // Two triangles on the same three points close a fan that has no inside.
    const bool is_flat = spokes_.size () == 2 && spokes_[0].out + spokes_[0].in == 2;
    if (joins + 1 < spokes_.size () || is_flat) {
      ++check_.nonmanifold_vertices;
      note (found_.broken_at, p);
    }
    for (const Spoke& spoke : spokes_) {
      slot_[spoke.to] = NONE;
      if (spoke.out + spoke.in == 1 && spoke.out == 1)
        boundary_.emplace_back (p, spoke.to);
      if (p < spoke.to)
        lookAtEdge (p, spoke);
    }
  }

  void lookAtTriangle (Index a, Index b, Index c)
  {
    const Eigen::Vector3d ab = points_.positions[b] - points_.positions[a];
    const Eigen::Vector3d ac = points_.positions[c] - points_.positions[a];
    const double sqr_longest =
        std::max ({ab.squaredNorm (), ac.squaredNorm (), (ac - ab).squaredNorm ()});
    const double sqr_height = ab.cross (ac).squaredNorm () / sqr_longest;
    const double precision = limits_.precision * points_.diagonal;
    const double flat = limits_.flat_height;
    if (sqr_height > precision * precision || sqr_height > flat * flat * sqr_longest)
      return;
    ++check_.degenerate_triangles;
    note (found_.degenerate_at, a);
  }

  void lookAtEdge (Index p, const Spoke& spoke)
  {
    const Index q = spoke.to;
    ++edges_;
    sets_.join (p, q);
    const Eigen::Vector3d pq = points_.positions[q] - points_.positions[p];
    const double scale = 0.5 * (static_cast<double> (spacing_[p]) + spacing_[q]);
    const double sqr_length = scale > 0.0 ? pq.squaredNorm () / (scale * scale) : 0.0;
    if (sqr_length > sqr_longest_) {
      sqr_longest_ = sqr_length;
      check_.longest_edge_at = {points_.cloud_index[p], points_.cloud_index[q]};
    }
    if (spoke.out + spoke.in == 1)
      return;
    if (spoke.out != 1 || spoke.in != 1) {
      ++(spoke.out + spoke.in > 2 ? check_.nonmanifold_edges : check_.orientation_conflicts);
      note (found_.broken_at, p);
      return;
    }
    if (sqr_length > limits_.long_edge * limits_.long_edge) {
      ++found_.long_edges;
      if (sqr_length > sqr_longest_inside_) {
        sqr_longest_inside_ = sqr_length;
        found_.longest_inside_at = {p, q};
      }
    }
    const std::vector<Eigen::Vector3d>& at = points_.positions;
    if (isFold (areaVector (at[p], at[q], at[spoke.left]),
                areaVector (at[p], at[spoke.right], at[q]))) {
      ++check_.folds;
      note (found_.fold_at, p);
    }
  }

  // Components by vertices. They are those by edges unless a vertex has several fans.
  void countComponents ()
  {
    std::vector<Index>& points_of_root = slot_;
    std::fill (points_of_root.begin (), points_of_root.end (), 0);
    for (Index p = 0; p < points_of_root.size (); ++p)
      if (triangles_at_.offsets[p] < triangles_at_.offsets[p + 1])
        ++points_of_root[sets_.find (p)];
    component_.assign (points_of_root.size (), NONE);
    for (Index p = 0; p < points_of_root.size (); ++p) {
      const std::size_t count = points_of_root[p];
      if (count == 0)
        continue;
      component_[p] = static_cast<Index> (check_.components++);
      found_.component_points.push_back (count);
      found_.largest_component = std::max (found_.largest_component, count);
      if (found_.smallest_component_at == NONE || count < found_.smallest_component) {
        found_.smallest_component = count;
        found_.smallest_component_at = p;
      }
    }
    if (check_.nonmanifold_vertices > 0)
      check_.components = componentsByEdges ();
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
  CsrLists triangles_at_;        // triangles around each point
  DisjointSets sets_;            // of points that are connected by edges
  std::vector<Index> slot_;      // per point: the spoke of the current point that leads to it
  std::vector<Index> component_; // of each root of the sets
  std::vector<Spoke> spokes_;
  std::vector<BoundaryEdge> boundary_;
  std::size_t edges_ = 0;
  double sqr_longest_ = 0.0, sqr_longest_inside_ = 0.0; // in local spacings
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
