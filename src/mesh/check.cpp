// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check.h"

#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/vertex_stars.h"

namespace pcl::floater {
std::vector<float>
spacingOfMesh (const TriangleMesh& mesh, const Positions& positions, const RunContext& run)
{
  std::vector<float> spacing (positions.size (), 0.0F);
  using Indices = std::vector<Index>;
  const auto measure = [&] (Index p, Indices& fan, Indices& ring, std::vector<float>& lengths) {
    if (mesh.triangle_of[p] == NONE)
      return;
    if (mesh.fan (p, fan, ring))
      ring.push_back (ring.front ()); // one of its edges counts twice
    lengths.clear ();
    for (const Index q : ring)
      lengths.push_back (static_cast<float> ((positions[q] - positions[p]).norm ()));
    spacing[p] = median (lengths);
  };
  parallelPoints<Indices, Indices, std::vector<float>> (run, positions.size (), measure);
  std::vector<float> known;
  std::copy_if (spacing.begin (), spacing.end (), std::back_inserter (known),
                [] (float value) { return value > 0.0F; });
  if (!known.empty ())
    std::replace (spacing.begin (), spacing.end (), 0.0F, median (known));
  return spacing;
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

namespace {
bool
isDegenerate (const Vector3d& a, const Vector3d& b, const Vector3d& c, double precision,
              double flat_height)
{
  const double sqr_longest =
      std::max ({(b - a).squaredNorm (), (c - a).squaredNorm (), (c - b).squaredNorm ()});
  const double sqr_height = areaVector (a, b, c).squaredNorm () / sqr_longest;
  return !(sqr_height > precision * precision ||
           sqr_height > flat_height * flat_height * sqr_longest);
}

// Whether the triangle across an edge has it in the other direction, and this one across it.
bool
isLinked (const TriangleMesh& mesh, MeshEdge e)
{
  if (mesh.neighbors[e.triangle][e.side] >= mesh.triangles.size ())
    return false;
  const MeshEdge mate = mesh.mate (e);
  return mesh.from (mate) == mesh.to (e) && mesh.to (mate) == mesh.from (e) &&
         mesh.neighbors[mate.triangle][mate.side] == e.triangle;
}

void
lookAtEdge (MeshEdge e, const TriangleMesh& mesh, const Positions& positions,
            const std::vector<float>& spacing, double long_edge, Figures& found)
{
  const auto [p, q] = std::minmax ({mesh.from (e), mesh.to (e)});
  const Index other = mesh.neighbors[e.triangle][e.side];
  if (other != NONE && !isLinked (mesh, e)) {
    found.broken.add ({1, p});
    return;
  }
  if (other < e.triangle)
    return;
  ++found.edges;
  const double scale = 0.5 * (static_cast<double> (spacing[p]) + spacing[q]);
  LongEdge edge{0.0, {p, q}};
  if (scale > 0.0)
    edge.sqr_length = (positions[q] - positions[p]).squaredNorm () / (scale * scale);
  found.longest.take (edge);
  if (other == NONE)
    return;
  if (edge.sqr_length > long_edge * long_edge) {
    found.long_edges.add ({1, p});
    found.longest_inside.take (edge);
  }
  const Vector3d normal = areaVectorOf (mesh.triangles[e.triangle], positions),
                 beyond = areaVectorOf (mesh.triangles[other], positions);
  constexpr double COSINE = 0.5; // of 60 degrees
  found.bent += normal.dot (beyond) < COSINE * normal.norm () * beyond.norm () ? 1 : 0;
  if (isFold (normal, beyond))
    found.folds.add ({1, p});
}

// Calls body (i, found) for 0 to count, on all threads.
template <typename Found, typename Body>
Found
sumOver (std::size_t count, const RunContext& run, const Body& body)
{
  std::vector<Found> ranges ((count + RANGE_LENGTH - 1) / RANGE_LENGTH);
  parallelRanges (run, count, [&] (std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      body (static_cast<Index> (i), ranges[first / RANGE_LENGTH]);
  });
  Found all;
  for (const Found& range : ranges)
    all.add (range);
  return all;
}

// Points whose triangles are not one fan.
FlawCount
findSeveralFans (const TriangleMesh& mesh, const RunContext& run)
{
  std::vector<Index> corners (mesh.triangle_of.size (), 0);
  for (const Triangle& t : mesh.triangles)
    for (const Index p : t)
      ++corners[p];
  return sumOver<FlawCount> (corners.size (), run, [&] (Index p, FlawCount& found) {
    Index in_fan = 0;
    for (FanWalk walk{mesh, p}; walk.triangle != NONE && in_fan <= corners[p]; walk.advance ())
      ++in_fan;
    if (in_fan != corners[p])
      found.add ({1, p});
  });
}

void
addComponentsAndLoops (const TriangleMesh& mesh, const Points& points,
                       const std::vector<float>& spacing, const RunContext& run,
                       MeshExamination& found)
{
  const MeshComponents components = findComponents (mesh, run);
  MeshCheck& check = found.check;
  check.components = components.count;
  found.component_points = countPoints (mesh, components);
  const auto [smallest, largest] =
      std::minmax_element (found.component_points.begin (), found.component_points.end ());
  if (components.count > 0) {
    found.smallest_component = *smallest;
    found.largest_component = *largest;
    const auto number = static_cast<Index> (smallest - found.component_points.begin ());
    const auto at =
        std::find_if (mesh.triangle_of.begin (), mesh.triangle_of.end (),
                      [&] (Index t) { return t != NONE && components.of_triangle[t] == number; });
    found.smallest_component_at = static_cast<Index> (at - mesh.triangle_of.begin ());
  }
  // Longest first; equal lengths by their smallest points.
  std::vector<std::pair<LoopSummary, BoundaryLoop>> loops;
  for (BoundaryLoop& loop : findBoundaryLoops (mesh, components, points.positions, spacing, run))
    loops.emplace_back (summaryOf (loop, points), std::move (loop));
  std::sort (loops.begin (), loops.end (), [] (const auto& a, const auto& b) {
    return a.first.length != b.first.length ? a.first.length > b.first.length
                                            : a.first.at < b.first.at;
  });
  for (auto& [summary, loop] : loops) {
    if (loop.points.size () == 2) { // an edge of two triangles that do not know each other
      ++check.nonmanifold_edges;
      found.figures.broken.add ({1, loop.points.front ()});
    }
    check.loops.push_back (summary);
    found.loops.push_back (std::move (loop));
  }
  // The Euler characteristic of a component is 2 - 2 genus - loops.
  check.genus = (2 * static_cast<std::int64_t> (check.components) -
                 static_cast<std::int64_t> (check.loops.size ()) - check.euler_characteristic) /
                2;
}

} // namespace

MeshExamination
checkMesh (const TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
           const RunContext& run, const CheckLimits& limits)
{
  const Positions& positions = points.positions;
  const auto look = [&, precision = limits.precision * points.diagonal] (Index t, Figures& range) {
    const auto [a, b, c] = mesh.triangles[t];
    if (!isProper (mesh.triangles[t], positions.size ())) {
      range.broken.add ({1, std::min ({a, b, c})});
      return;
    }
    if (isDegenerate (positions[a], positions[b], positions[c], precision, limits.flat_height))
      range.degenerate.add ({1, std::min ({a, b, c})});
    for (std::uint8_t side = 0; side < 3; ++side)
      lookAtEdge ({t, side}, mesh, positions, spacing, limits.long_edge, range);
  };
  MeshExamination found;
  found.figures = sumOver<Figures> (mesh.triangles.size (), run, look);
  Figures& figures = found.figures;
  MeshCheck& check = found.check;
  check.done = true;
  check.nonmanifold_edges = figures.broken.count;
  if (figures.broken.count == 0) {
    figures.broken = findSeveralFans (mesh, run);
    check.nonmanifold_vertices = figures.broken.count;
  }
  check.folds = figures.folds.count;
  check.degenerate_triangles = figures.degenerate.count;
  check.longest_edge = std::sqrt (figures.longest.sqr_length);
  if (figures.longest.sqr_length > 0.0)
    check.longest_edge_at = {points.cloud_index[figures.longest.at.first],
                             points.cloud_index[figures.longest.at.second]};
  found.unused = indicesWhere (mesh.triangle_of.size (),
                               [&] (Index p) { return mesh.triangle_of[p] == NONE; });
  check.euler_characteristic = static_cast<std::int64_t> (points.size () - found.unused.size ()) -
                               static_cast<std::int64_t> (figures.edges) +
                               static_cast<std::int64_t> (mesh.triangles.size ());
  if (figures.broken.count == 0)
    addComponentsAndLoops (mesh, points, spacing, run, found);
  return found;
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
