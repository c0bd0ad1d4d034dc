// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/vertex_stars.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
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
// Length of an edge in local spacings, and its ends, the smaller one first.
struct LongEdge
{
  double sqr_length = 0.0;
  std::pair<Index, Index> at{};

  void take (const LongEdge& other)
  {
    if (other.sqr_length > sqr_length)
      *this = other;
  }
};

// Number of some flaws, and the smallest point of one, NONE if there is none.
struct Flaws
{
  std::size_t count = 0;
  Index at = NONE;

  void add (const Flaws& more)
  {
    count += more.count;
    at = std::min (at, more.at);
  }
};

// What is found at a range of triangles. Edges belong to the smaller triangle.
struct Figures
{
  std::size_t edges = 0;
  Flaws broken, folds, degenerate, long_edges;
  LongEdge longest, longest_inside;

  void add (const Figures& more)
  {
    edges += more.edges;
    broken.add (more.broken);
    folds.add (more.folds);
    degenerate.add (more.degenerate);
    long_edges.add (more.long_edges);
    longest.take (more.longest);
    longest_inside.take (more.longest_inside);
  }
};

class TriangleCheck
{
public:
  TriangleCheck (const TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
                 const CheckLimits& limits)
      : mesh_ (mesh), positions_ (points.positions), spacing_ (spacing), limits_ (limits),
        precision_ (limits.precision * points.diagonal)
  {
  }

  void look (Index t, Figures& found) const
  {
    const auto [a, b, c] = mesh_.triangles[t];
    if (!isProper (mesh_.triangles[t], positions_.size ())) {
      found.broken.add ({1, std::min ({a, b, c})});
      return;
    }
    if (isDegenerate (positions_[a], positions_[b], positions_[c]))
      found.degenerate.add ({1, std::min ({a, b, c})});
    for (std::uint8_t side = 0; side < 3; ++side)
      lookAtEdge ({t, side}, found);
  }

private:
  bool isDegenerate (const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                     const Eigen::Vector3d& c) const
  {
    const double sqr_longest =
        std::max ({(b - a).squaredNorm (), (c - a).squaredNorm (), (c - b).squaredNorm ()});
    const double sqr_height = areaVector (a, b, c).squaredNorm () / sqr_longest;
    return !(sqr_height > precision_ * precision_ ||
             sqr_height > limits_.flat_height * limits_.flat_height * sqr_longest);
  }

  void lookAtEdge (MeshEdge e, Figures& found) const
  {
    const Index from = mesh_.from (e), to = mesh_.to (e);
    const Index p = std::min (from, to), q = std::max (from, to);
    const Index other = mesh_.neighbors[e.triangle][e.side];
    if (other != NONE && !isLinked (e)) {
      found.broken.add ({1, p});
      return;
    }
    if (other < e.triangle)
      return;
    ++found.edges;
    const double scale = 0.5 * (static_cast<double> (spacing_[p]) + spacing_[q]);
    LongEdge edge{0.0, {p, q}};
    if (scale > 0.0)
      edge.sqr_length = (positions_[q] - positions_[p]).squaredNorm () / (scale * scale);
    found.longest.take (edge);
    if (other == NONE)
      return;
    if (edge.sqr_length > limits_.long_edge * limits_.long_edge) {
      found.long_edges.add ({1, p});
      found.longest_inside.take (edge);
    }
    if (isFold (areaVectorOf (mesh_.triangles[e.triangle], positions_),
                areaVectorOf (mesh_.triangles[other], positions_)))
      found.folds.add ({1, p});
  }

  // Whether the triangle across an edge has it in the other direction, and this one across it.
  bool isLinked (MeshEdge e) const
  {
    const Index other = mesh_.neighbors[e.triangle][e.side];
    if (other >= mesh_.triangles.size ())
      return false;
    const MeshEdge mate = mesh_.mate (e);
    return mesh_.from (mate) == mesh_.to (e) && mesh_.to (mate) == mesh_.from (e) &&
           mesh_.neighbors[mate.triangle][mate.side] == e.triangle;
  }

  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<float>& spacing_;
  const CheckLimits& limits_;
  double precision_;
};

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
Flaws
findSeveralFans (const TriangleMesh& mesh, const RunContext& run)
{
  std::vector<Index> corners (mesh.triangle_of.size (), 0);
  for (const Triangle& t : mesh.triangles)
    for (const Index p : t)
      ++corners[p];
  return sumOver<Flaws> (corners.size (), run, [&] (Index p, Flaws& found) {
    Index in_fan = 0;
    for (FanWalk walk (mesh, p); walk.triangle () != NONE && in_fan <= corners[p]; walk.advance ())
      ++in_fan;
    if (in_fan != corners[p])
      found.add ({1, p});
  });
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
      found.broken_at = std::min (found.broken_at, loop.points.front ());
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
  const TriangleCheck triangles (mesh, points, spacing, limits);
  const auto figures = sumOver<Figures> (
      mesh.triangles.size (), run, [&] (Index t, Figures& range) { triangles.look (t, range); });
  MeshExamination found;
  MeshCheck& check = found.check;
  check.done = true;
  check.nonmanifold_edges = figures.broken.count;
  Flaws broken = figures.broken;
  if (broken.count == 0) {
    const Flaws several = findSeveralFans (mesh, run);
    check.nonmanifold_vertices = several.count;
    broken.add (several);
  }
  found.broken_at = broken.at;
  check.folds = figures.folds.count;
  found.fold_at = figures.folds.at;
  check.degenerate_triangles = figures.degenerate.count;
  found.degenerate_at = figures.degenerate.at;
  found.long_edges = figures.long_edges.count;
  found.longest_inside = std::sqrt (figures.longest_inside.sqr_length);
  found.longest_inside_at = figures.longest_inside.at;
  check.longest_edge = std::sqrt (figures.longest.sqr_length);
  if (figures.longest.sqr_length > 0.0)
    check.longest_edge_at = {points.cloud_index[figures.longest.at.first],
                             points.cloud_index[figures.longest.at.second]};
  for (Index p = 0; p < mesh.triangle_of.size (); ++p)
    if (mesh.triangle_of[p] == NONE)
      found.unused.push_back (p);
  check.euler_characteristic = static_cast<std::int64_t> (points.size () - found.unused.size ()) -
                               static_cast<std::int64_t> (figures.edges) +
                               static_cast<std::int64_t> (mesh.triangles.size ());
  if (broken.count == 0)
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
