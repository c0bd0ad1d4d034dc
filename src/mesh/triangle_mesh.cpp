// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_mesh.h"

#include "core/disjoint_sets.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/vertex_stars.h"

namespace pcl::floater {
void
TriangleMesh::fan (Index p, std::vector<Index>& fan_triangles) const
{
  fan_triangles.clear ();
  std::ptrdiff_t anti_clockwise = 0;
  for (FanWalk walk{*this, p}; walk.triangle != NONE; walk.advance ()) {
    fan_triangles.push_back (walk.triangle);
    anti_clockwise += walk.is_clockwise ? 0 : 1;
  }
  // At the boundary: the clockwise ones come first.
  const auto middle = fan_triangles.begin () + anti_clockwise;
  std::reverse (middle, fan_triangles.end ());
  std::rotate (fan_triangles.begin (), middle, fan_triangles.end ());
}

bool
TriangleMesh::fan (Index p, std::vector<Index>& fan_triangles, std::vector<Index>& ring) const
{
  fan (p, fan_triangles);
  ring.clear ();
  for (const Index t : fan_triangles)
    ring.push_back (from ({t, sideOf (t, p)}));
  if (ring.empty ())
    return false;
  const Index end = to ({fan_triangles.back (), sideOf (fan_triangles.back (), p)});
  const bool is_closed = end == ring.front ();
  if (!is_closed)
    ring.push_back (end);
  return is_closed;
}

// Walks both fans in step, so the smaller one decides: the other may be a hub with a fan as large
// as the mesh. Of two hubs, the edge may be anywhere.
bool
TriangleMesh::hasEdge (Index p, Index q) const
{
  constexpr int HUB = 500; // triangles
  FanWalk around_p{*this, p}, around_q{*this, q};
  for (int steps = 0; around_p.triangle != NONE && around_q.triangle != NONE; ++steps) {
    if (steps == HUB || isCorner (triangles[around_p.triangle], q) ||
        isCorner (triangles[around_q.triangle], p))
      return true;
    around_p.advance ();
    around_q.advance ();
  }
  return false;
}

Index
TriangleMesh::triangleWith (const Triangle& corners) const
{
  for (const Index p : corners) // each may have several fans, see connect ()
    for (FanWalk walk{*this, p}; walk.triangle != NONE; walk.advance ())
      if (std::is_permutation (corners.begin (), corners.end (), triangles[walk.triangle].begin ()))
        return walk.triangle;
  return NONE;
}

void
TriangleMesh::undo (std::size_t mark)
{
  for (; changes_.size () > mark; changes_.pop_back ()) {
    const Entry& entry = changes_.back ();
    if (entry.triangle == NONE) {
      triangle_of[entry.neighbors[0]] = entry.neighbors[1];
      continue;
    }
    triangles[entry.triangle] = entry.corners;
    neighbors[entry.triangle] = entry.neighbors;
  }
}

std::vector<Index>
TriangleMesh::changedTriangles () const
{
  std::vector<Index> changed;
  for (const Entry& entry : changes_)
    if (entry.triangle != NONE)
      changed.push_back (entry.triangle);
  sortUnique (changed);
  return changed;
}

void
TriangleMesh::link (Index t, std::uint8_t side, MeshEdge other)
{
  neighbors[t][side] = other.triangle;
  if (other.triangle == NONE)
    return;
  note (other.triangle);
  neighbors[other.triangle][other.side] = t;
}

void
TriangleMesh::flip (MeshEdge e)
{
  const MeshEdge m = mate (e);
  const Index c = corner (e), a = from (e), b = to (e), d = corner (m);
  const Index t = e.triangle, u = m.triangle;
  const MeshEdge across_bc = mate ({t, next (e.side)});     // opposite to a
  const MeshEdge across_ca = mate ({t, previous (e.side)}); // opposite to b
  const MeshEdge across_ad = mate ({u, next (m.side)});     // opposite to b in the neighbour
  const MeshEdge across_db = mate ({u, previous (m.side)}); // opposite to a in the neighbour
  set (t, {c, a, d});
  set (u, {d, b, c});
  link (t, 0, across_ad);
  link (t, 2, across_ca);
  link (u, 0, across_bc);
  link (u, 2, across_db);
  neighbors[t][1] = u;
  neighbors[u][1] = t;
  setTriangleOf (a, t);
  setTriangleOf (c, t);
  setTriangleOf (b, u);
  setTriangleOf (d, u);
}

MeshEdge
TriangleMesh::attach (MeshEdge e, Index p)
{
  const auto t = static_cast<Index> (triangles.size ());
  triangles.push_back ({p, to (e), from (e)});
  neighbors.push_back ({NONE, NONE, NONE});
  link (t, 0, e);
  setTriangleOf (p, t);
  return {t, 0};
}

void
TriangleMesh::split (Index t, Index p, Index u, Index v)
{
  const Triangle corners = triangles[t];
  const MeshEdge across_1 = mate ({t, 1}); // c a
  const MeshEdge across_2 = mate ({t, 2}); // a b
  const Index across_0 = neighbors[t][0];
  set (t, {p, corners[1], corners[2]});
  set (u, {p, corners[2], corners[0]});
  set (v, {p, corners[0], corners[1]});
  neighbors[t] = {across_0, u, v};
  neighbors[u] = {NONE, v, t};
  neighbors[v] = {NONE, t, u};
  link (u, 0, across_1);
  link (v, 0, across_2);
  setTriangleOf (p, t);
  setTriangleOf (corners[0], u);
}

void
TriangleMesh::replaceFan (Index p, const std::vector<Index>& fan_triangles,
                          const std::vector<Triangle>& filling)
{
  // The ends of each new edge, those of the polygon first, and its mate.
  std::vector<std::pair<std::array<Index, 2>, MeshEdge>> mates;
  for (const Index t : fan_triangles) {
    const MeshEdge e{t, sideOf (t, p)};
    mates.push_back ({{from (e), to (e)}, mate (e)});
  }
  for (std::size_t i = 0; i < filling.size (); ++i) {
    const Index t = fan_triangles[i];
    set (t, filling[i]);
    for (std::uint8_t side = 0; side < 3; ++side)
      mates.push_back ({{to ({t, side}), from ({t, side})}, {t, side}});
  }
  for (std::size_t i = 0; i < filling.size (); ++i)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const MeshEdge e{fan_triangles[i], side};
      const std::array<Index, 2> ends{from (e), to (e)};
      setTriangleOf (ends[0], e.triangle);
      link (e.triangle, side,
            std::find_if (mates.begin (), mates.end (), [&ends] (const auto& edge) {
              return edge.first == ends;
            })->second);
    }
  setTriangleOf (p, NONE);
}

// Both triangles of an edge are in the star of each of its ends, so the stars suffice.
bool
TriangleMesh::connect (std::size_t points, const RunContext& run, const Flags* may_be_split)
{
  // Tables of edges have 3 entries per triangle.
  requireCountable (3 * triangles.size (), NONE - 1, "a table of edges", "use fewer points");
  run.poll ();
  triangle_of.resize (points);
  neighbors.resize (triangles.size ());
  const TriangleRanges ranges (triangles, points, run);
  std::atomic<bool> is_manifold{ranges.leftOut () == 0};
  parallelTasks (run, ranges.count (), [&] (std::size_t r) {
    if (!is_manifold)
      return;
    const VertexStars stars (triangles, ranges, r);
    StarOrder order;
    for (std::size_t p = ranges.firstPoint (r); p < ranges.lastPoint (r) && is_manifold; ++p) {
      const VertexStar star = stars.of (p);
      triangle_of[p] = star.size () == 0 ? NONE : star[star.size () - 1].triangle;
      const bool is_ordered = order.set (star);
      for (std::size_t i = 0; is_ordered && i < star.size (); ++i) {
        const Index u = star[i].triangle, before = order.before (i);
        neighbors[u][previous (sideOf (u, static_cast<Index> (p)))] =
            before == NONE ? NONE : star[before].triangle;
      }
      const bool may_be = may_be_split != nullptr && (*may_be_split)[p] != 0;
      if (!is_ordered || !(may_be || order.isOneFan ()))
        is_manifold = false;
    }
  });
  return is_manifold;
}

std::vector<MeshEdge>
boundaryEdges (const TriangleMesh& mesh)
{
  std::vector<MeshEdge> edges;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] == NONE)
        edges.push_back ({t, side});
  return edges;
}

Flags
boundaryPoints (const TriangleMesh& mesh)
{
  Flags is_boundary (mesh.triangle_of.size (), 0);
  for (const MeshEdge e : boundaryEdges (mesh))
    is_boundary[mesh.from (e)] = is_boundary[mesh.to (e)] = 1;
  return is_boundary;
}

std::vector<std::vector<Index>>
boundaryLoops (const TriangleMesh& mesh, const RunContext& run)
{
  std::vector<Index> successor (mesh.triangle_of.size (), NONE);
  run.poll ();
  for (const MeshEdge e : boundaryEdges (mesh))
    successor[mesh.from (e)] = mesh.to (e);
  std::vector<std::vector<Index>> loops;
  for (Index start = 0; start < successor.size (); ++start) {
    if (successor[start] == NONE)
      continue;
    std::vector<Index> loop;
    for (Index p = start; successor[p] != NONE;) {
      loop.push_back (p);
      const Index q = successor[p];
      successor[p] = NONE;
      p = q;
    }
    loops.push_back (std::move (loop));
  }
  return loops;
}

MeshComponents
findComponents (const TriangleMesh& mesh, const RunContext& run)
{
  DisjointSets sets (mesh.triangles.size ());
  ProgressLoop progress (run);
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    progress.next ();
    for (const Index u : mesh.neighbors[t])
      if (u < t) // each edge once; NONE is above
        sets.join (u, t);
  }
  MeshComponents components;
  components.of_triangle = std::move (sets).number ([&components] (Index) {
    ++components.count;
    return true;
  });
  return components;
}

std::vector<std::size_t>
countPoints (const TriangleMesh& mesh, const MeshComponents& components)
{
  std::vector<std::size_t> points (components.count, 0);
  for (Index t : mesh.triangle_of)
    if (t != NONE)
      ++points[components.of_triangle[t]];
  return points;
}

void
addRing (const TriangleMesh& mesh, std::vector<Index>& patch)
{
  std::vector<Index> wider, fan;
  for (const Index v : patch) {
    mesh.fan (v, fan);
    for (const Index t : fan)
      wider.insert (wider.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
  }
  sortUnique (wider);
  patch.swap (wider);
}

} // namespace pcl::floater
