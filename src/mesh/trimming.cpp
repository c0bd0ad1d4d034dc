// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/trimming.h"

#include "mesh/self_intersections.h"
#include "mesh/triangle_removal.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

namespace pcl::floater {
namespace {
// Tolerance for edges as long as the limit; positions are in a box of diagonal 1.
constexpr double LENGTH_ROUNDING = 1e-15;

bool
isTooLong (Index p, Index q, const Points& points, const std::vector<float>& spacing,
           const TrimmingOptions& options)
{
  const double length = (points.positions[q] - points.positions[p]).norm () - LENGTH_ROUNDING;
  const double unit = 0.5 * (static_cast<double> (spacing[p]) + spacing[q]);
  return (options.maximum_edge_length > 0.0 &&
          length > options.maximum_edge_length / points.scale) ||
         (options.maximum_edge_ratio > 0.0 && length > options.maximum_edge_ratio * unit);
}

void
cutLongEdges (TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
              const TrimmingOptions& options, const RunContext& run)
{
  std::vector<std::uint8_t> is_removed (mesh.triangles.size (), 0);
  ProgressLoop progress (run);
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    progress.next ();
    const Triangle& triangle = mesh.triangles[t];
    for (std::size_t i = 0; i < 3; ++i)
      if (isTooLong (triangle[i], triangle[(i + 1) % 3], points, spacing, options))
        is_removed[t] = 1;
  }
  removeTriangles (mesh, std::move (is_removed), run);
}

// Greedy cover: a set of triangles with one of each pair. O(pairs log pairs).
std::vector<std::uint8_t>
coverPairs (std::size_t triangles, const std::vector<CrossingPair>& pairs, const RunContext& run)
{
  std::unordered_map<Index, std::vector<Index>> partners;
  for (const CrossingPair& pair : pairs) {
    partners[pair.first].push_back (pair.second);
    partners[pair.second].push_back (pair.first);
  }
  // Most uncovered partners first, then the smallest triangle.
  std::unordered_map<Index, std::size_t> left;
  std::set<std::pair<std::size_t, Index>> order;
  const auto key = [&] (Index t) { return std::make_pair (pairs.size () - left[t], t); };
  for (const auto& [t, others] : partners) {
    left[t] = others.size ();
    order.insert (key (t));
  }
  std::vector<std::uint8_t> is_in (triangles, 0);
  ProgressLoop progress (run);
  while (!order.empty ()) {
    const Index t = order.begin ()->second;
    order.erase (order.begin ());
    if (left[t] == 0)
      break; // the rest has none, either
    is_in[t] = 1;
    for (const Index u : partners[t]) {
      progress.next ();
      if (is_in[u] != 0)
        continue;
      order.erase (key (u));
      --left[u];
      order.insert (key (u));
    }
  }
  return is_in;
}

// \return number of triangles cut off
std::size_t
cutCrossing (TriangleMesh& mesh, const Points& points, const RunContext& run)
{
  const std::size_t before = mesh.triangles.size ();
  const std::vector<CrossingPair> pairs =
      findSelfIntersections (mesh.triangles, points.positions, run);
  removeTriangles (mesh, coverPairs (before, pairs, run), run);
  return before - mesh.triangles.size ();
}

} // namespace

bool
asksForTrimming (const TrimmingOptions& options)
{
  return options.maximum_edge_length > 0.0 || options.maximum_edge_ratio > 0.0 ||
         options.open_self_intersections || options.minimum_component_size > 0;
}

Trimming
trimMesh (TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
          const TrimmingOptions& options, const RunContext& run)
{
  Trimming done;
  const std::size_t triangles = mesh.triangles.size ();
  const std::vector<Index> before = mesh.triangle_of;
  cutLongEdges (mesh, points, spacing, options, run);
  if (options.open_self_intersections)
    done.crossing = cutCrossing (mesh, points, run);
  if (options.minimum_component_size > 0)
    done.components = removeSmallComponents (
        mesh, static_cast<std::size_t> (options.minimum_component_size), run);
  done.triangles = triangles - mesh.triangles.size ();
  for (Index p = 0; p < before.size (); ++p)
    if (before[p] != NONE && mesh.triangle_of[p] == NONE)
      done.points.push_back (p);
  return done;
}

} // namespace pcl::floater
