// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/flips.h"

#include "core/parallel.h"
#include "mesh/vertex_stars.h"

namespace pcl::floater {
void
orientNormals (const TriangleMesh& mesh, const Positions& positions, Normals& normals,
               const RunContext& run, const Flags& is_remade)
{
  const TriangleRanges ranges (mesh.triangles, normals.size (), run);
  parallelTasks (run, ranges.count (), [&] (std::size_t r) {
    const std::size_t first = ranges.firstPoint (r), points = ranges.lastPoint (r) - first;
    Normals area (points, Vector3f::Zero ());
    for (const Index triangle : ranges.of (r)) {
      const Triangle& t = mesh.triangles[triangle];
      const Vector3f area_vector = areaVectorOf (t, positions).cast<float> ();
      for (const Index p : t)
        if (p - first < points) // also false if p is below
          area[p - first] += area_vector;
    }
    for (std::size_t p = 0; p < points; ++p)
      if (!is_remade.empty () && is_remade[first + p] != 0)
        normals[first + p] = area[p].normalized (); // zero stays zero
      else if (normals[first + p].dot (area[p]) < 0.0F)
        normals[first + p] = -normals[first + p];
  });
}

std::size_t
EdgeFlipper::flipAll ()
{
  constexpr std::size_t EDGES_PER_POLL = 256;
  const std::size_t pushed = stack.size ();
  std::size_t edges = 0, flips = 0;
  ProgressLoop progress (run, pushed);
  while (!stack.empty ()) {
    if (++edges % EDGES_PER_POLL == 0)
      progress.reach (pushed - std::min (pushed, stack.size ()));
    const MeshEdge e = stack.back ();
    stack.pop_back ();
    if (!improves (e))
      continue;
    const MeshEdge m = mesh.mate (e);
    mesh.flip (e);
    ++flips;
    for (const Index t : {e.triangle, m.triangle})
      for (const std::uint8_t side : {std::uint8_t{0}, std::uint8_t{2}})
        if (mesh.neighbors[t][side] != NONE)
          stack.push_back ({t, side});
  }
  return flips;
}

bool
EdgeFlipper::improves (MeshEdge e) const
{
  const MeshEdge m = mesh.mate (e);
  if (m.triangle == NONE)
    return false;
  const Index c = mesh.corner (e), a = mesh.from (e), b = mesh.to (e), d = mesh.corner (m);
  const TriangleCost::Value now_cab = cost ({c, a, b}), now_dba = cost ({d, b, a});
  const TriangleCost::Value then_cad = cost ({c, a, d}), then_dbc = cost ({d, b, c});
  const double now = now_cab.cost + now_dba.cost;
  const double then = then_cad.cost + then_dbc.cost;
  if (then >= now && now_cab.unit_normal.dot (now_dba.unit_normal) >= 0.0)
    return false;
  // Normals across the other edges of the two triangles; zero at the boundary, so that edges there
  // cost 0.
  const auto across = [this] (Index t, std::uint8_t side) {
    const Index other = mesh.neighbors[t][side];
    return other == NONE ? Vector3d (Vector3d::Zero ()) : cost (mesh.triangles[other]).unit_normal;
  };
  const Vector3d at_bc = across (e.triangle, TriangleMesh::next (e.side));
  const Vector3d at_ca = across (e.triangle, TriangleMesh::previous (e.side));
  const Vector3d at_ad = across (m.triangle, TriangleMesh::next (m.side));
  const Vector3d at_db = across (m.triangle, TriangleMesh::previous (m.side));
  constexpr auto at_edge = TriangleCost::ofEdge;
  const double total = now + at_edge (now_cab.unit_normal, now_dba.unit_normal) +
                       at_edge (at_bc, now_cab.unit_normal) + at_edge (at_ca, now_cab.unit_normal) +
                       at_edge (at_ad, now_dba.unit_normal) + at_edge (at_db, now_dba.unit_normal);
  const double total_then =
      then + at_edge (then_cad.unit_normal, then_dbc.unit_normal) +
      at_edge (at_bc, then_dbc.unit_normal) + at_edge (at_ca, then_cad.unit_normal) +
      at_edge (at_ad, then_cad.unit_normal) + at_edge (at_db, then_dbc.unit_normal);
  constexpr double IMPROVES = 1e-9; // relative; a smaller gain may be rounding
  return total_then < total - IMPROVES * std::abs (total) && !mesh.hasEdge (c, d);
}

std::size_t
flipEdges (TriangleMesh& mesh, const TriangleCost& cost, const RunContext& run)
{
  constexpr std::size_t TRIANGLES_PER_TASK = 8192; // worth a cache of costs
  const std::size_t count = mesh.triangles.size ();
  std::vector<std::vector<MeshEdge>> found ((count + TRIANGLES_PER_TASK - 1) / TRIANGLES_PER_TASK);
  parallelTasks (run, found.size (), [&] (std::size_t task) {
    CachedCost cached{cost};
    const EdgeFlipper flipper{mesh, cached, run};
    const auto last = static_cast<Index> (std::min (count, (task + 1) * TRIANGLES_PER_TASK));
    for (auto t = static_cast<Index> (task * TRIANGLES_PER_TASK); t < last; ++t)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index u = mesh.neighbors[t][side];
        if (u != NONE && t < u && flipper.improves ({t, side}))
          found[task].push_back ({t, side});
      }
  });
  CachedCost cached{cost};
  EdgeFlipper flipper{mesh, cached, run};
  for (auto task = found.rbegin (); task != found.rend (); ++task)
    flipper.stack.insert (flipper.stack.end (), task->rbegin (), task->rend ());
  return flipper.flipAll ();
}

} // namespace pcl::floater
