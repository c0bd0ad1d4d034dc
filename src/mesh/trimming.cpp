// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/trimming.h"

#include "core/csr_lists.h"
#include "core/parallel.h"
#include "mesh/self_intersections.h"

#include <algorithm>
#include <utility>

namespace pcl::floater {
namespace {
class TriangleRemoval
{
public:
  TriangleRemoval (TriangleMesh& mesh, std::vector<std::uint8_t> is_removed, const RunContext& run)
      : mesh_ (mesh), run_ (run), is_removed_ (std::move (is_removed))
  {
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      if (is_removed_[t] != 0)
        changed_.insert (changed_.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
  }

  void run ()
  {
    if (changed_.empty ())
      return; // no triangle is removed, and no array of triangles is needed
    ProgressLoop progress (run_);
    while (!changed_.empty ()) {
      progress.next ();
      const Index p = changed_.back ();
      changed_.pop_back ();
      keepLargestFan (p);
    }
    Index kept = 0;
    for (Index t = 0; t < mesh_.triangles.size (); ++t)
      if (is_removed_[t] == 0)
        mesh_.triangles[kept++] = mesh_.triangles[t];
    mesh_.triangles.resize (kept);
    mesh_.connect (mesh_.triangle_of.size (), run_);
  }

private:
  void takeOut (Index t)
  {
    if (is_removed_[t] != 0)
      return;
    is_removed_[t] = 1;
    changed_.insert (changed_.end (), mesh_.triangles[t].begin (), mesh_.triangles[t].end ());
  }

  // The triangles around p are one fan of the original mesh; the remaining ones form runs.
  void keepLargestFan (Index p)
  {
    const bool is_closed = mesh_.fan (p, fan_, ring_);
    const auto isKept = [this] (Index t) { return is_removed_[t] == 0; };
    // In a closed fan, a run may go on from the last triangle to the first: begin at a gap.
    if (is_closed)
      std::rotate (fan_.begin (), std::find_if_not (fan_.begin (), fan_.end (), isKept),
                   fan_.end ());
    std::size_t largest = 0, length = 0, end = 0;
    for (std::size_t i = 0; i < fan_.size (); ++i) {
      length = isKept (fan_[i]) ? length + 1 : 0;
      if (length > largest) {
        largest = length;
        end = i + 1;
      }
    }
    for (std::size_t i = 0; i < fan_.size (); ++i)
      if (i + largest < end || i >= end)
        takeOut (fan_[i]);
  }

  TriangleMesh& mesh_;
  RunContext run_;
  std::vector<std::uint8_t> is_removed_; // of each triangle
  std::vector<Index> changed_;           // points that lost a triangle, possibly repeated
  std::vector<Index> fan_, ring_;        // of the current point
};

} // namespace

void
removeTriangles (TriangleMesh& mesh, std::vector<std::uint8_t> is_removed, const RunContext& run)
{
  TriangleRemoval (mesh, std::move (is_removed), run).run ();
}

std::size_t
removeSmallComponents (TriangleMesh& mesh, std::size_t fewest_points, const RunContext& run)
{
  const MeshComponents components = findComponents (mesh, run);
  const std::vector<std::size_t> points = countPoints (mesh, components);
  std::vector<std::uint8_t> is_removed (mesh.triangles.size (), 0);
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    is_removed[t] = points[components.of_triangle[t]] < fewest_points ? 1 : 0;
  removeTriangles (mesh, std::move (is_removed), run);
  return static_cast<std::size_t> (
      std::count_if (points.begin (), points.end (),
                     [fewest_points] (std::size_t count) { return count < fewest_points; }));
}

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
  parallelRanges (run, is_removed.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t)
      for (std::size_t i = 0; i < 3; ++i)
        if (isTooLong (mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3], points, spacing,
                       options))
          is_removed[t] = 1;
  });
  removeTriangles (mesh, std::move (is_removed), run);
}

// Of each triangle, whether it is cut off: of each pair one, those of most pairs first.
std::vector<std::uint8_t>
coverPairs (std::size_t triangles, const std::vector<CrossingPair>& pairs)
{
  const CsrLists partners = makeCsrLists (triangles, [&pairs] (const auto& emit) {
    for (const CrossingPair& pair : pairs) {
      emit (pair.first, pair.second);
      emit (pair.second, pair.first);
    }
  });
  std::vector<Index> order;
  for (Index t = 0; t < triangles; ++t)
    if (partners.row (t).size () > 0)
      order.push_back (t);
  std::stable_sort (order.begin (), order.end (), [&partners] (Index t, Index u) {
    return partners.row (t).size () > partners.row (u).size ();
  });
  std::vector<std::uint8_t> is_in (triangles, 0);
  for (const Index t : order) {
    const Row row = partners.row (t);
    is_in[t] = std::any_of (row.begin (), row.end (), [&is_in] (Index u) { return is_in[u] == 0; })
                   ? 1
                   : 0;
  }
  return is_in;
}

// \return number of triangles cut off
std::size_t
cutCrossing (TriangleMesh& mesh, const Points& points, const RunContext& run)
{
  const std::size_t before = mesh.triangles.size ();
  const CrossingPairs pairs = findSelfIntersections (mesh.triangles, points.positions, run);
  std::vector<std::uint8_t> is_cut = coverPairs (before, pairs);
  for (const Index t : pairs.untested)
    is_cut[t] = 1;
  removeTriangles (mesh, is_cut, run);
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
