// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/collapsed_regions.h"

#include "core/order_statistics.h"

#include <algorithm>

namespace pcl::floater {
namespace {
template <typename Vector>
double
sqrLengths (const std::vector<Vector>& at, const Triangle& t)
{
  return (at[t[1]] - at[t[0]]).squaredNorm () + (at[t[2]] - at[t[1]]).squaredNorm () +
         (at[t[0]] - at[t[2]]).squaredNorm ();
}

template <typename Vector>
double
perimeter (const std::vector<Vector>& at, const std::vector<Index>& loop)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size (); ++i)
    sum += (at[loop[(i + 1) % loop.size ()]] - at[loop[i]]).norm ();
  return sum;
}

// Marks the corners of collapsed triangles, except for points of the loop.
// \return empty if no triangle has collapsed
std::vector<std::uint8_t>
markDeepPoints (const TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
                const RunContext& run, const DiscLimits& limits)
{
  const double scale = limits.collapsed_scale * perimeter (uv, loop) / perimeter (positions, loop);
  const double sqr_scale = scale * scale;
  std::vector<std::uint8_t> deep;
  ProgressLoop progress (run);
  for (const Triangle& t : mesh.triangles) {
    progress.next ();
    if (sqrLengths (uv, t) >= sqr_scale * sqrLengths (positions, t))
      continue;
    if (deep.empty ())
      deep.assign (uv.size (), 0);
    for (const Index p : t)
      deep[p] = 1;
  }
  if (!deep.empty ())
    for (const Index p : loop)
      deep[p] = 0;
  return deep;
}

// Marks the triangles that are connected with the boundary without crossing an edge between two
// deep points. The rest is enclosed by deep points. Since no such edge is crossed, none of them
// joins two points of a region's loop on the outside.
std::vector<std::uint8_t>
reachFromBoundary (const TriangleMesh& mesh, const std::vector<std::uint8_t>& deep,
                   const RunContext& run)
{
  std::vector<std::uint8_t> reached (mesh.triangles.size (), 0);
  std::vector<Index> waiting;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (const Index neighbor : mesh.neighbors[t])
      if (neighbor == NONE && reached[t] == 0) {
        reached[t] = 1;
        waiting.push_back (t);
      }
  ProgressLoop progress (run);
  while (!waiting.empty ()) {
    progress.next ();
    const Index t = waiting.back ();
    waiting.pop_back ();
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index u = mesh.neighbors[t][side];
      if (u == NONE || reached[u] != 0 ||
          (deep[mesh.from ({t, side})] != 0 && deep[mesh.to ({t, side})] != 0))
        continue;
      reached[u] = 1;
      waiting.push_back (u);
    }
  }
  return reached;
}

// Takes and returns the untaken triangles that are connected with `start` by edges.
std::vector<Index>
collectTriangles (const TriangleMesh& mesh, Index start, std::vector<std::uint8_t>& taken,
                  const RunContext& run)
{
  std::vector<Index> triangles{start};
  taken[start] = 1;
  ProgressLoop progress (run);
  for (std::size_t head = 0; head < triangles.size (); ++head) {
    progress.next ();
    for (const Index u : mesh.neighbors[triangles[head]])
      if (u != NONE && taken[u] == 0) {
        taken[u] = 1;
        triangles.push_back (u);
      }
  }
  std::sort (triangles.begin (), triangles.end ());
  return triangles;
}

bool
contains (const std::vector<Index>& sorted, Index element)
{
  return std::binary_search (sorted.begin (), sorted.end (), element);
}

// The boundary loop of a region, from its smallest point on. Region and rest are both connected by
// edges, so the edges between them are one simple cycle.
// \param triangles of the region, ascending
// \return empty if there is no such cycle, since the mesh is no disc
std::vector<Index>
orderLoop (const TriangleMesh& mesh, const std::vector<Index>& triangles)
{
  std::vector<std::array<Index, 2>> edges;
  for (const Index t : triangles)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (!contains (triangles, mesh.neighbors[t][side]))
        edges.push_back ({mesh.from ({t, side}), mesh.to ({t, side})});
  std::sort (edges.begin (), edges.end ());
  std::vector<Index> loop;
  for (auto at = edges.begin (); at != edges.end () && loop.size () < edges.size ();) {
    loop.push_back ((*at)[0]);
    const Index next = (*at)[1];
    at = std::lower_bound (edges.begin (), edges.end (), std::array<Index, 2>{next, 0});
    if (next == loop.front ())
      break;
  }
  if (loop.size () != edges.size ())
    loop.clear ();
  return loop;
}

// Points with parameters but without a triangle, sorted by their parameters. Each coincides with a
// vertex, or lies beyond the loop.
class LostPoints
{
public:
  LostPoints (const TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv) : uv_ (uv)
  {
    for (Index p = 0; p < uv.size (); ++p)
      if (mesh.triangle_of[p] == NONE && uv[p].allFinite ())
        points_.push_back (p);
    std::sort (points_.begin (), points_.end (), [this] (Index p, Index q) {
      return before (uv_[p], uv_[q]) || (!before (uv_[q], uv_[p]) && p < q);
    });
    taken_.assign (points_.size (), 0);
  }

  // Appends the points that coincide with vertex v and are in no list yet.
  void takeAt (Index v, std::vector<Index>& list)
  {
    auto at = std::lower_bound (
        points_.begin (), points_.end (), uv_[v],
        [this] (Index p, const Eigen::Vector2d& place) { return before (uv_[p], place); });
    for (; at != points_.end () && uv_[*at] == uv_[v]; ++at) {
      std::uint8_t& taken = taken_[static_cast<std::size_t> (at - points_.begin ())];
      if (taken == 0)
        list.push_back (*at);
      taken = 1;
    }
  }

private:
  static bool before (const Eigen::Vector2d& a, const Eigen::Vector2d& b)
  {
    return a.x () < b.x () || (a.x () == b.x () && a.y () < b.y ());
  }

  const std::vector<Eigen::Vector2d>& uv_;
  std::vector<Index> points_;
  std::vector<std::uint8_t> taken_;
};

std::vector<Index>
collectInterior (const TriangleMesh& mesh, const CollapsedRegion& region, LostPoints& lost)
{
  std::vector<Index> corners;
  for (const Index t : region.triangles)
    corners.insert (corners.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
  sortUnique (corners);
  std::vector<Index> loop = region.loop, interior;
  std::sort (loop.begin (), loop.end ());
  std::set_difference (corners.begin (), corners.end (), loop.begin (), loop.end (),
                       std::back_inserter (interior));
  for (const Index v : corners)
    lost.takeAt (v, interior);
  std::sort (interior.begin (), interior.end ());
  return interior;
}

} // namespace

std::vector<CollapsedRegion>
findCollapsedRegions (const TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                      const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
                      const RunContext& run, const DiscLimits& limits)
{
  std::vector<CollapsedRegion> regions;
  const std::vector<std::uint8_t> deep = markDeepPoints (mesh, uv, positions, loop, run, limits);
  if (deep.empty ())
    return regions;
  std::vector<std::uint8_t> taken = reachFromBoundary (mesh, deep, run);
  LostPoints lost (mesh, uv);
  for (Index start = 0; start < mesh.triangles.size (); ++start) {
    if (taken[start] != 0)
      continue;
    CollapsedRegion region;
    region.triangles = collectTriangles (mesh, start, taken, run);
    region.loop = orderLoop (mesh, region.triangles);
    if (region.loop.empty ())
      continue;
    region.interior = collectInterior (mesh, region, lost);
    if (!region.interior.empty ())
      regions.push_back (std::move (region));
  }
  return regions;
}

} // namespace pcl::floater
