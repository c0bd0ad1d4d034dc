// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/examination.h"

#include "core/geometry.h"
#include "core/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl::floater {
namespace {
// Number of spokes up to which linear search is faster than a hash table. Measured.
constexpr std::size_t MANY_AROUND = 32;

void
note (Index& place, Index p)
{
  place = std::min (place, p);
}

template <typename T>
void
appendTo (std::vector<T>& list, const std::vector<T>& next)
{
  list.insert (list.end (), next.begin (), next.end ());
}

} // namespace

void
Surroundings::append (Surroundings&& next)
{
  const Surroundings other = std::move (next); // frees its memory
  edges += other.edges;
  nonmanifold_vertices += other.nonmanifold_vertices;
  nonmanifold_edges += other.nonmanifold_edges;
  orientation_conflicts += other.orientation_conflicts;
  degenerate_triangles += other.degenerate_triangles;
  folds += other.folds;
  long_edges += other.long_edges;
  note (broken_at, other.broken_at);
  note (degenerate_at, other.degenerate_at);
  note (fold_at, other.fold_at);
  if (other.sqr_longest > sqr_longest) {
    sqr_longest = other.sqr_longest;
    longest_at = other.longest_at;
  }
  if (other.sqr_longest_inside > sqr_longest_inside) {
    sqr_longest_inside = other.sqr_longest_inside;
    longest_inside_at = other.longest_inside_at;
  }
  appendTo (unused, other.unused);
  appendTo (boundary, other.boundary);
}

Surroundings
SurroundingsCheck::lookAround (const TriangleRanges& ranges, std::size_t r, const RunContext& run)
{
  found_ = {};
  last_ = ranges.lastPoint (r);
  const VertexStars stars (mesh_.triangles, ranges, r);
  ProgressLoop progress (run);
  for (auto p = static_cast<Index> (ranges.firstPoint (r)); p < last_; ++p) {
    progress.next ();
    const VertexStar star = stars.of (p);
    if (star.size () == 0)
      found_.unused.push_back (p);
    else
      lookAt (p, star);
  }
  return std::move (found_);
}

Index
SurroundingsCheck::spokeTo (Index q)
{
  const auto added = static_cast<Index> (spokes_.size ());
  if (added < MANY_AROUND) {
    for (Index i = 0; i < added; ++i)
      if (spokes_[i].to == q)
        return i;
  }
  else {
    if (added == MANY_AROUND) {
      place_ = {}; // not clear (): it visits all buckets of an earlier, larger table
      for (Index i = 0; i < added; ++i)
        place_.emplace (spokes_[i].to, i);
    }
    const auto [at, is_new] = place_.emplace (q, added);
    if (!is_new)
      return at->second;
  }
  spokes_.push_back ({q, 0, 0, NONE, NONE, added});
  return added;
}

Index
SurroundingsCheck::fanOf (Index spoke)
{
  while (spokes_[spoke].fan != spoke)
    spoke = spokes_[spoke].fan = spokes_[spokes_[spoke].fan].fan;
  return spoke;
}

void
SurroundingsCheck::lookAt (Index p, const VertexStar& star)
{
  spokes_.clear ();
  std::size_t joins = 0;
  for (const Wedge& wedge : star) {
    const Index q = wedge.next, r = wedge.previous;
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
  // Two triangles on the same three points form a closed fan without inside.
  const bool is_flat = spokes_.size () == 2 && spokes_[0].out + spokes_[0].in == 2;
  if (joins + 1 < spokes_.size () || is_flat) {
    ++found_.nonmanifold_vertices;
    note (found_.broken_at, p);
  }
  for (const Spoke& spoke : spokes_) {
    if (spoke.out + spoke.in == 1 && spoke.out == 1)
      found_.boundary.emplace_back (p, spoke.to);
    if (p < spoke.to)
      lookAtEdge (p, spoke);
  }
}

void
SurroundingsCheck::lookAtTriangle (Index a, Index b, Index c)
{
  const Eigen::Vector3d ab = mesh_.positions[b] - mesh_.positions[a];
  const Eigen::Vector3d ac = mesh_.positions[c] - mesh_.positions[a];
  const double sqr_longest =
      std::max ({ab.squaredNorm (), ac.squaredNorm (), (ac - ab).squaredNorm ()});
  const double sqr_height = ab.cross (ac).squaredNorm () / sqr_longest;
  const double precision = limits_.precision * mesh_.diagonal;
  const double flat = limits_.flat_height;
  if (sqr_height > precision * precision || sqr_height > flat * flat * sqr_longest)
    return;
  ++found_.degenerate_triangles;
  note (found_.degenerate_at, a);
}

void
SurroundingsCheck::lookAtEdge (Index p, const Spoke& spoke)
{
  const Index q = spoke.to;
  ++found_.edges;
  if (q < last_)
    sets_.join (p, q);
  else
    found_.leaving.emplace_back (p, q);
  const Eigen::Vector3d pq = mesh_.positions[q] - mesh_.positions[p];
  const double scale = 0.5 * (static_cast<double> (mesh_.spacing[p]) + mesh_.spacing[q]);
  const double sqr_length = scale > 0.0 ? pq.squaredNorm () / (scale * scale) : 0.0;
  if (sqr_length > found_.sqr_longest) {
    found_.sqr_longest = sqr_length;
    found_.longest_at = {p, q};
  }
  if (spoke.out + spoke.in == 1)
    return;
  if (spoke.out != 1 || spoke.in != 1) {
    ++(spoke.out + spoke.in > 2 ? found_.nonmanifold_edges : found_.orientation_conflicts);
    note (found_.broken_at, p);
    return;
  }
  if (sqr_length > limits_.long_edge * limits_.long_edge) {
    ++found_.long_edges;
    if (sqr_length > found_.sqr_longest_inside) {
      found_.sqr_longest_inside = sqr_length;
      found_.longest_inside_at = {p, q};
    }
  }
  const std::vector<Eigen::Vector3d>& at = mesh_.positions;
  if (isFold (areaVector (at[p], at[q], at[spoke.left]),
              areaVector (at[p], at[spoke.right], at[q]))) {
    ++found_.folds;
    note (found_.fold_at, p);
  }
}

Surroundings
lookAround (const ExaminedMesh& mesh, const TriangleRanges& ranges, const CheckLimits& limits,
            DisjointSets& sets, const RunContext& run)
{
  std::vector<Surroundings> found (ranges.count ());
  parallelTasks (run, ranges.count (), [&] (std::size_t r) {
    found[r] = SurroundingsCheck (mesh, limits, sets).lookAround (ranges, r, run);
  });
  Surroundings all;
  ProgressLoop progress (run);
  for (Surroundings& part : found) {
    for (const auto& [p, q] : part.leaving) {
      progress.next ();
      sets.join (p, q);
    }
    all.append (std::move (part));
  }
  return all;
}

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
makeExamination (ExaminedParts parts, const ExaminedMesh& mesh, const std::vector<Index>& component,
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
