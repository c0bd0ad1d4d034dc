// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/surface_mesh.h"

#include <algorithm>

namespace pcl
{
namespace floater
{
void
SurfaceMesh::fan (Index p, std::vector<Index>& fan_triangles) const
{
  fan_triangles.clear ();
  const Index start = triangle_of[p];
  if (start == NONE)
    return;
  // Clockwise to the boundary, or once around.
  Index first = start;
  while (true) {
    const Index clockwise = neighbors[first][previous (sideOf (first, p))];
    if (clockwise == NONE || clockwise == start)
      break;
    first = clockwise;
  }
  if (neighbors[first][previous (sideOf (first, p))] != NONE)
    first = start; // closed
  for (Index t = first; t != NONE;) {
    fan_triangles.push_back (t);
    t = neighbors[t][next (sideOf (t, p))];
    if (t == first)
      break;
  }
}

bool
SurfaceMesh::hasEdge (Index p, Index q) const
{
  const Index start = triangle_of[p];
  for (Index t = start; t != NONE;) {
    if (triangles[t][0] == q || triangles[t][1] == q || triangles[t][2] == q)
      return true;
    t = neighbors[t][next (sideOf (t, p))];
    if (t == start)
      return false;
  }
  for (Index t = start; t != NONE; t = neighbors[t][previous (sideOf (t, p))])
    if (triangles[t][0] == q || triangles[t][1] == q || triangles[t][2] == q)
      return true;
  return false;
}

void
SurfaceMesh::link (Index t, std::uint8_t side, MeshEdge other)
{
  neighbors[t][side] = other.triangle;
  if (other.triangle != NONE)
    neighbors[other.triangle][other.side] = t;
}

void
SurfaceMesh::flip (MeshEdge e)
{
  const MeshEdge m = mate (e);
  const Index c = corner (e), a = from (e), b = to (e), d = corner (m);
  const Index t = e.triangle, u = m.triangle;
  const MeshEdge across_bc = mate ({t, next (e.side)});     // opposite to a
  const MeshEdge across_ca = mate ({t, previous (e.side)}); // opposite to b
  const MeshEdge across_ad = mate ({u, next (m.side)});     // opposite to b in the neighbour
  const MeshEdge across_db = mate ({u, previous (m.side)}); // opposite to a in the neighbour
  triangles[t] = {c, a, d};
  triangles[u] = {d, b, c};
  link (t, 0, across_ad);
  link (t, 2, across_ca);
  link (u, 0, across_bc);
  link (u, 2, across_db);
  neighbors[t][1] = u;
  neighbors[u][1] = t;
  triangle_of[a] = t;
  triangle_of[c] = t;
  triangle_of[b] = u;
  triangle_of[d] = u;
}

void
SurfaceMesh::split (Index t, Index p)
{
  const Triangle corners = triangles[t];
  const MeshEdge across_1 = mate ({t, 1}); // c a
  const MeshEdge across_2 = mate ({t, 2}); // a b
  const auto u = static_cast<Index> (triangles.size ());
  const Index v = u + 1;
  triangles[t] = {p, corners[1], corners[2]};
  triangles.push_back ({p, corners[2], corners[0]});
  triangles.push_back ({p, corners[0], corners[1]});
  neighbors[t] = {neighbors[t][0], u, v};
  neighbors.push_back ({NONE, v, t});
  neighbors.push_back ({NONE, t, u});
  link (u, 0, across_1);
  link (v, 0, across_2);
  triangle_of[p] = t;
  triangle_of[corners[0]] = u;
}

bool
SurfaceMesh::connect (std::size_t points)
{
  // Directed edges bucketed by their first point.
  triangle_of.assign (points, NONE);
  neighbors.assign (triangles.size (), {NONE, NONE, NONE});
  std::vector<Index> offsets (points + 1, 0);
  for (const Triangle& corners : triangles)
    for (Index p : corners)
      ++offsets[p + 1];
  for (std::size_t p = 0; p < points; ++p)
    offsets[p + 1] += offsets[p];
  std::vector<MeshEdge> leaving (3 * triangles.size ());
  {
    std::vector<Index> at (offsets.begin (), offsets.end () - 1);
    for (Index t = 0; t < triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index p = from ({t, side});
        leaving[at[p]++] = {t, side};
        triangle_of[p] = t;
      }
  }
  for (Index p = 0; p < points; ++p)
    for (Index i = offsets[p]; i < offsets[p + 1]; ++i) {
      const MeshEdge e = leaving[i];
      const Index q = to (e);
      if (q == p)
        return false;
      for (Index j = i + 1; j < offsets[p + 1]; ++j)
        if (to (leaving[j]) == q)
          return false; // the same directed edge twice
      for (Index j = offsets[q]; j < offsets[q + 1]; ++j)
        if (to (leaving[j]) == p)
          neighbors[e.triangle][e.side] = leaving[j].triangle;
    }
  std::vector<Index> fan_triangles;
  for (Index p = 0; p < points; ++p) {
    fan (p, fan_triangles);
    if (fan_triangles.size () != offsets[p + 1] - offsets[p])
      return false; // more than one fan
  }
  return true;
}

std::vector<std::vector<Index>>
boundaryLoops (const SurfaceMesh& mesh)
{
  std::vector<Index> successor (mesh.triangle_of.size (), NONE);
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] == NONE)
        successor[mesh.from ({t, side})] = mesh.to ({t, side});
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

} // namespace floater
} // namespace pcl
