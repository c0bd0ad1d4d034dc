// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/trimming.h"

#include "core/parallel.h"
#include "mesh/self_intersections.h"

namespace pcl::floater {
namespace {
// Sets `fan` to the triangles around p, but for the largest run of those that remain.
void
findBesideLargestRun (const TriangleMesh& mesh, Index p, const Flags& is_removed,
                      std::vector<Index>& fan, std::vector<Index>& ring)
{
  const auto isKept = [&is_removed] (Index t) { return is_removed[t] == 0; };
  // In a closed fan, a run may go on from the last triangle to the first: begin at a gap.
  if (mesh.fan (p, fan, ring))
    std::rotate (fan.begin (), std::find_if_not (fan.begin (), fan.end (), isKept), fan.end ());
  std::ptrdiff_t largest = 0, length = 0, end = 0;
  for (std::size_t i = 0; i < fan.size (); ++i) {
    length = isKept (fan[i]) ? length + 1 : 0;
    if (length > largest) {
      largest = length;
      end = static_cast<std::ptrdiff_t> (i + 1);
    }
  }
  fan.erase (fan.begin () + (end - largest), fan.begin () + end);
}

void
cutLongEdges (TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
              const TrimmingOptions& options, const RunContext& run)
{
  const auto isTooLong = [&] (Index p, Index q) {
    // Tolerance for edges as long as the limit; positions are in a box of diagonal 1.
    constexpr double LENGTH_ROUNDING = 1e-15;
    const double length = (points.positions[q] - points.positions[p]).norm () - LENGTH_ROUNDING;
    const double unit = 0.5 * (static_cast<double> (spacing[p]) + spacing[q]);
    return (options.maximum_edge_length > 0.0 &&
            length > options.maximum_edge_length / points.scale) ||
           (options.maximum_edge_ratio > 0.0 && length > options.maximum_edge_ratio * unit);
  };
  Flags is_removed (mesh.triangles.size (), 0);
  parallelPoints (run, is_removed.size (), [&] (Index t) {
    const auto& [a, b, c] = mesh.triangles[t];
    is_removed[t] = isTooLong (a, b) || isTooLong (b, c) || isTooLong (c, a) ? 1 : 0;
  });
  removeTriangles (mesh, std::move (is_removed), run);
}

// Of each triangle, whether it is cut off: of each pair one, those of most pairs first.
Flags
coverPairs (std::size_t triangles, const std::vector<CrossingPair>& pairs)
{
  const CsrLists partners = makeCsrLists (triangles, [&pairs] (const auto& emit) {
    for (const CrossingPair& pair : pairs) {
      emit (pair.first, pair.second);
      emit (pair.second, pair.first);
    }
  });
  std::vector<Index> order =
      indicesWhere (triangles, [&] (Index t) { return partners.row (t).size () > 0; });
  std::stable_sort (order.begin (), order.end (), [&partners] (Index t, Index u) {
    return partners.row (t).size () > partners.row (u).size ();
  });
  Flags is_in (triangles, 0);
  for (const Index t : order) {
    const Row row = partners.row (t);
    is_in[t] = std::any_of (row.begin (), row.end (), [&is_in] (Index u) { return is_in[u] == 0; })
                   ? 1
                   : 0;
  }
  return is_in;
}

} // namespace

void
removeTriangles (TriangleMesh& mesh, Flags is_removed, const RunContext& run)
{
  std::vector<Index> changed; // points that lost a triangle, possibly repeated
  const auto addCorners = [&] (Index t) {
    changed.insert (changed.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
  };
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (is_removed[t] != 0)
      addCorners (t);
  if (changed.empty ())
    return; // no array of triangles is needed
  ProgressLoop progress (run);
  std::vector<Index> fan, ring;
  while (!changed.empty ()) {
    progress.next ();
    findBesideLargestRun (mesh, changed.back (), is_removed, fan, ring);
    changed.pop_back ();
    for (const Index t : fan)
      if (std::exchange (is_removed[t], std::uint8_t{1}) == 0)
        addCorners (t);
  }
  Index kept = 0;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (is_removed[t] == 0)
      mesh.triangles[kept++] = mesh.triangles[t];
  mesh.triangles.resize (kept);
  mesh.connect (mesh.triangle_of.size (), run);
}

std::size_t
removeSmallComponents (TriangleMesh& mesh, std::size_t fewest_points, const RunContext& run)
{
  const MeshComponents components = findComponents (mesh, run);
  const std::vector<std::size_t> points = countPoints (mesh, components);
  Flags is_removed (mesh.triangles.size (), 0);
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    is_removed[t] = points[components.of_triangle[t]] < fewest_points ? 1 : 0;
  removeTriangles (mesh, std::move (is_removed), run);
  return static_cast<std::size_t> (
      std::count_if (points.begin (), points.end (),
                     [fewest_points] (std::size_t count) { return count < fewest_points; }));
}

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
  if (options.open_self_intersections) {
    const std::size_t before_cut = mesh.triangles.size ();
    const CrossingPairs pairs = findSelfIntersections (mesh.triangles, points.positions, run);
    Flags is_cut = coverPairs (before_cut, pairs);
    for (const Index t : pairs.untested)
      is_cut[t] = 1;
    removeTriangles (mesh, std::move (is_cut), run);
    done.crossing = before_cut - mesh.triangles.size ();
  }
  if (options.minimum_component_size > 0)
    done.components = removeSmallComponents (
        mesh, static_cast<std::size_t> (options.minimum_component_size), run);
  done.triangles = triangles - mesh.triangles.size ();
  done.points = indicesWhere (
      before.size (), [&] (Index p) { return before[p] != NONE && mesh.triangle_of[p] == NONE; });
  return done;
}

} // namespace pcl::floater
