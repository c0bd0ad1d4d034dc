// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry.h"
#include "core/order_statistics.h"
#include "floater/floater_method.h"
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

// The boundary loop of a region, from its smallest point on. Region and rest are both connected by
// edges, so the edges between them are one simple cycle.
// \param triangles of the region, ascending
// \return empty if there is no such cycle, since the mesh is no disc
std::vector<Index>
loopAround (const TriangleMesh& mesh, const std::vector<Index>& triangles)
{
  std::map<Index, Index> next;
  std::size_t edges = 0;
  for (const Index t : triangles)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (!std::binary_search (triangles.begin (), triangles.end (), mesh.neighbors[t][side])) {
        next[mesh.from ({t, side})] = mesh.to ({t, side});
        ++edges;
      }
  std::vector<Index> loop;
  for (auto at = next.begin (); at != next.end (); at = next.find (at->second)) {
    loop.push_back (at->first);
    if (at->second == loop.front () || loop.size () == edges)
      break;
  }
  return loop.size () == edges ? loop : std::vector<Index> ();
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
    region.loop = loopAround (mesh, region.triangles);
    if (region.loop.empty ())
      continue;
    for (const Index t : region.triangles)
      region.points.insert (region.points.end (), mesh.triangles[t].begin (),
                            mesh.triangles[t].end ());
    sortUnique (region.points);
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

// Whether the boundary of the mesh is the loop.
bool
fillsLoop (const TriangleMesh& mesh, const std::vector<Index>& loop, const RunContext& run)
{
  std::vector<std::vector<Index>> loops = boundaryLoops (mesh, run);
  if (loops.size () != 1)
    return false;
  std::vector<Index>& found = loops.front ();
  std::rotate (found.begin (), std::find (found.begin (), found.end (), loop.front ()),
               found.end ());
  return found == loop;
}

// What all regions are laid out with.
struct Surroundings
{
  const std::vector<Eigen::Vector3d>& positions;
  const CsrLists& nearest;
  const std::vector<Eigen::Vector3f>& normals;
  const StarSettings& stars;
  DiscOptions options; // on a circle
  RunContext run;
  const DiscLimits& limits;
  std::vector<Index> number; // of each point in the current disc; NONE: not in it
};

// Lays a region out on a circle of its own, with the neighbours among its points.
// \return without triangles if there is no solution that fills its loop
PlaneDisc
layOut (const CollapsedRegion& region, const PlaneDisc& around, Surroundings& with)
{
  PlaneDisc disc;
  disc.level = around.level + 1;
  std::vector<Eigen::Vector3f> normals;
  for (const Index p : region.points) {
    const Index in_cloud = around.points[p];
    with.number[in_cloud] = static_cast<Index> (disc.points.size ());
    disc.points.push_back (in_cloud);
    normals.push_back (with.normals[in_cloud]);
  }
  disc.positions = valuesAt (with.positions, disc.points);
  for (const Index p : region.loop)
    disc.loop.push_back (with.number[around.points[p]]);
  CsrLists nearest;
  nearest.offsets.push_back (0);
  for (const Index p : disc.points) {
    for (const Index q : with.nearest.row (p))
      if (with.number[q] != NONE)
        nearest.ids.push_back (with.number[q]);
    nearest.offsets.push_back (static_cast<Index> (nearest.ids.size ()));
  }
  for (const Index p : disc.points)
    with.number[p] = NONE;
  Parameterization parameterization =
      parameterize (disc.positions, nearest,
                    makeStars (disc.positions, nearest, normals, Rows::all (disc.positions.size ()),
                               with.stars, with.run),
                    disc.loop, with.options, with.run, with.limits);
  if (parameterization.problem)
    return disc;
  disc.uv = std::move (parameterization.uv);
  disc.mesh = triangulatePlane (disc.uv, disc.loop);
  if (!fillsLoop (disc.mesh, disc.loop, with.run))
    disc.mesh.triangles.clear ();
  return disc;
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
  Surroundings with{positions, nearest, normals, star_settings, options, within, limits, {}};
  with.options.domain.curve = Domain::CIRCLE;
  with.number.assign (positions.size (), NONE);
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
      PlaneDisc part = layOut (region, disc, with);
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
