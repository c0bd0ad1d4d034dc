// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry.h"
#include "core/order_statistics.h"
#include "floater/floater_method.h"
#include "floater/mesh_piece.h"
#include "floater/planar_delaunay.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace pcl::floater {
namespace {
// A disc that is laid out in the plane. Its points are numbered from 0.
struct PlaneDisc
{
  std::vector<Index> points; // their indices in the whole cloud, ascending
  std::vector<Index> loop;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector2d> uv;
  TriangleMesh mesh;
  std::size_t level = 0; // of the recursion
};

// A disc of triangles that is too small in the plane, with all its points. It shares no point with the
// boundary of the mesh, and no edge outside of it joins two points of its loop, so it can be
// triangulated alone. Regions share no triangle, edge or interior point.
struct CollapsedRegion
{
  std::vector<Index> triangles; // ascending
  std::vector<Index> loop;      // in order, the region on the left; their parameters are accurate
  std::vector<Index> points; // ascending; all, and those without a triangle that coincide with one
};

template <typename Vector>
double
sqrLengths (const std::vector<Vector>& at, const Triangle& t)
{
  return (at[t[1]] - at[t[0]]).squaredNorm () + (at[t[2]] - at[t[1]]).squaredNorm () +
         (at[t[0]] - at[t[2]]).squaredNorm ();
}

// Marks the corners of collapsed triangles, except for points of the loop.
// \return empty if no triangle has collapsed
std::vector<std::uint8_t>
markDeepPoints (const TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
                const RunContext& run, const DiscLimits& limits)
{
  const double scale = limits.collapsed_scale * perimeter (uv, loop) / perimeter (positions, loop);
  std::vector<std::uint8_t> deep;
  ProgressLoop progress (run);
  for (const Triangle& t : mesh.triangles) {
    progress.next ();
    if (sqrLengths (uv, t) >= scale * scale * sqrLengths (positions, t))
      continue;
    deep.resize (uv.size (), 0);
    for (const Index p : t)
      deep[p] = 1;
  }
  if (!deep.empty ())
    for (const Index p : loop)
      deep[p] = 0;
  return deep;
}

// Takes and returns the given triangles, and the untaken ones that are connected with them by edges
// that may be crossed.
template <typename Crosses>
std::vector<Index>
takeConnected (const TriangleMesh& mesh, std::vector<Index> triangles,
               std::vector<std::uint8_t>& taken, const RunContext& run, const Crosses& crosses)
{
  for (const Index t : triangles)
    taken[t] = 1;
  ProgressLoop progress (run);
  for (std::size_t head = 0; head < triangles.size (); ++head) {
    progress.next ();
    for (std::uint8_t side = 0; side < 3; ++side) {
      const MeshEdge edge{triangles[head], side};
      const Index beyond = mesh.neighbors[edge.triangle][side];
      if (beyond != NONE && taken[beyond] == 0 && crosses (edge)) {
        taken[beyond] = 1;
        triangles.push_back (beyond);
      }
    }
  }
  return triangles;
}

// The regions whose scale, relative to that of the loop, is below DiscLimits::collapsed_scale. One
// pass over the triangles without such regions, otherwise O(n log n).
std::vector<CollapsedRegion>
findCollapsedRegions (const PlaneDisc& disc, const RunContext& run, const DiscLimits& limits)
{
  const TriangleMesh& mesh = disc.mesh;
  const std::vector<std::uint8_t> deep =
      markDeepPoints (mesh, disc.uv, disc.positions, disc.loop, run, limits);
  if (deep.empty ())
    return {};
  // What is connected with the boundary without crossing an edge between two deep points is in no
  // region; so none of these edges joins two points of a region's loop on the outside.
  std::vector<Index> at_boundary;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (std::count (mesh.neighbors[t].begin (), mesh.neighbors[t].end (), NONE) > 0)
      at_boundary.push_back (t);
  std::vector<std::uint8_t> taken (mesh.triangles.size (), 0);
  takeConnected (mesh, std::move (at_boundary), taken, run, [&] (MeshEdge edge) {
    return deep[mesh.from (edge)] == 0 || deep[mesh.to (edge)] == 0;
  });
  // Points with parameters but without a triangle: each coincides with a vertex, or lies beyond the
  // loop.
  std::map<std::pair<double, double>, std::vector<Index>> lost;
  for (Index p = 0; p < disc.uv.size (); ++p)
    if (mesh.triangle_of[p] == NONE && disc.uv[p].allFinite ())
      lost[{disc.uv[p].x (), disc.uv[p].y ()}].push_back (p);
  std::vector<CollapsedRegion> regions;
  for (Index start = 0; start < mesh.triangles.size (); ++start) {
    if (taken[start] != 0)
      continue;
    CollapsedRegion region;
    region.triangles = takeConnected (mesh, {start}, taken, run, [] (MeshEdge) { return true; });
    std::sort (region.triangles.begin (), region.triangles.end ());
    MeshPiece piece = cutOut (mesh.triangles, region.triangles, disc.positions);
    if (piece.loop.empty ())
      continue;
    region.points = std::move (piece.points);
    region.loop = valuesAt (region.points, piece.loop);
    for (std::size_t i = 0, vertices = region.points.size (); i < vertices; ++i) {
      const Eigen::Vector2d& uv = disc.uv[region.points[i]];
      if (const auto found = lost.find ({uv.x (), uv.y ()}); found != lost.end ()) {
        region.points.insert (region.points.end (), found->second.begin (), found->second.end ());
        lost.erase (found); // a vertex may be on the loops of two regions
      }
    }
    sortUnique (region.points);
    if (region.points.size () > region.loop.size ())
      regions.push_back (std::move (region));
  }
  return regions;
}

} // namespace

std::size_t
layOutCollapsedRegions (TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                        const std::vector<Eigen::Vector3d>& positions, const CsrLists& nearest,
                        const std::vector<Eigen::Vector3f>& normals, const std::vector<Index>& loop,
                        const StarSettings& star_settings, const DiscOptions& options,
                        const RunContext& run, const DiscLimits& limits)
{
  if (markDeepPoints (mesh, uv, positions, loop, run, limits).empty ())
    return 0;
  const RunContext within = run.withinStage ();
  DiscOptions on_circle = options;
  on_circle.domain.curve = Domain::CIRCLE;
  // Lays a region out on a circle of its own, with the neighbours among its points. Without triangles
  // if there is no solution that fills its loop.
  const auto layOut = [&] (const CollapsedRegion& region, const PlaneDisc& around) {
    PlaneDisc disc;
    disc.level = around.level + 1;
    disc.points = valuesAt (around.points, region.points);
    disc.positions = valuesAt (positions, disc.points);
    const auto numberOf = [&disc] (Index in_cloud) {
      const auto at = std::lower_bound (disc.points.begin (), disc.points.end (), in_cloud);
      return at == disc.points.end () || *at != in_cloud
                 ? NONE
                 : static_cast<Index> (at - disc.points.begin ());
    };
    for (const Index p : region.loop)
      disc.loop.push_back (numberOf (around.points[p]));
    CsrLists among;
    among.offsets.push_back (0);
    for (const Index p : disc.points) {
      for (const Index q : nearest.row (p))
        if (const Index number = numberOf (q); number != NONE)
          among.ids.push_back (number);
      among.offsets.push_back (static_cast<Index> (among.ids.size ()));
    }
    Parameterization parameterization =
        parameterize (disc.positions, among,
                      makeStars (disc.positions, among, valuesAt (normals, disc.points),
                                 Rows::all (disc.positions.size ()), star_settings, within),
                      disc.loop, on_circle, within, limits);
    if (parameterization.problem)
      return disc;
    disc.uv = std::move (parameterization.uv);
    disc.mesh = triangulatePlane (disc.uv, disc.loop);
    // Both loops begin at their smallest point.
    if (boundaryLoops (disc.mesh, within) != std::vector<std::vector<Index>>{disc.loop})
      disc.mesh.triangles.clear ();
    return disc;
  };
  std::vector<PlaneDisc> waiting (1);
  waiting[0] = {std::vector<Index> (positions.size ()), loop, positions, uv, mesh};
  std::iota (waiting[0].points.begin (), waiting[0].points.end (), Index{0});
  TriangleMesh whole;
  std::size_t levels = 0;
  while (!waiting.empty ()) {
    PlaneDisc disc = std::move (waiting.back ());
    waiting.pop_back ();
    levels = std::max (levels, disc.level);
    for (const CollapsedRegion& region : findCollapsedRegions (disc, within, limits)) {
      PlaneDisc part = layOut (region, disc);
      if (part.mesh.triangles.empty ())
        continue; // it stays in the mesh
      waiting.push_back (std::move (part));
      for (const Index t : region.triangles)
        disc.mesh.triangles[t][0] = NONE;
    }
    for (const auto& [a, b, c] : disc.mesh.triangles)
      if (a != NONE)
        whole.triangles.push_back ({disc.points[a], disc.points[b], disc.points[c]});
  }
  if (levels == 0 || !whole.connect (positions.size (), run))
    return 0;
  mesh = std::move (whole);
  return levels;
}

} // namespace pcl::floater
