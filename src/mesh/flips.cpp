// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/flips.h"

#include "core/geometry.h"
#include "core/parallel.h"
#include "mesh/mesh_blocks.h"
#include "mesh/vertex_stars.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace pcl::floater {
namespace {
constexpr double IMPROVES = 1e-9; // relative; a smaller gain may be rounding
constexpr std::size_t EDGES_PER_POLL = 256;
} // namespace

void
orientNormals (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               std::vector<Eigen::Vector3f>& normals, const RunContext& run)
{
  const TriangleRanges ranges (mesh.triangles, normals.size (), run);
  parallelTasks (run, ranges.count (), [&] (std::size_t r) {
    const std::size_t first = ranges.firstPoint (r), points = ranges.lastPoint (r) - first;
    std::vector<Eigen::Vector3f> area (points, Eigen::Vector3f::Zero ());
    ranges.forEach (r, [&] (Index triangle) {
      const Triangle& t = mesh.triangles[triangle];
      const Eigen::Vector3f area_vector =
          areaVector (positions[t[0]], positions[t[1]], positions[t[2]]).cast<float> ();
      for (const Index p : t)
        if (p - first < points) // also false if p is below
          area[p - first] += area_vector;
    });
    for (std::size_t p = 0; p < points; ++p)
      if (normals[first + p].dot (area[p]) < 0.0F)
        normals[first + p] = -normals[first + p];
  });
}

double
splitCost (const TriangleMesh& mesh, CachedCost& cost, Index t, Index p, double limit)
{
  const auto [a, b, c] = mesh.triangles[t];
  const TriangleCost::Value whole = cost (a, b, c);
  double added = -whole.cost;
  std::array<Eigen::Vector3d, 3> across;
  for (std::uint8_t side = 0; side < 3; ++side) {
    across[side] = normalAcross (mesh, cost, {t, side});
    added -= cost.plain ().ofEdge (whole.unit_normal, across[side]);
  }
  // All following terms are 0 or more.
  const std::array<Triangle, 3> corners{{{p, b, c}, {p, c, a}, {p, a, b}}};
  std::array<Eigen::Vector3d, 3> part;
  for (std::uint8_t side = 0; side < 3; ++side) {
    // Not cached: nearly all of these splits are never made.
    const TriangleCost::Value value = cost.once (p, corners[side][1], corners[side][2]);
    part[side] = value.unit_normal;
    added += value.cost;
    if (added > limit)
      return added;
  }
  for (std::uint8_t side = 0; side < 3; ++side)
    added += cost.plain ().ofEdge (part[side], part[TriangleMesh::next (side)]) +
             cost.plain ().ofEdge (part[side], across[side]);
  return added;
}

double
EdgeFlipper::run ()
{
  double change = 0.0;
  const std::size_t pushed = stack_.size ();
  std::size_t edges = 0;
  ProgressLoop progress (run_, pushed);
  while (!stack_.empty ()) {
    if (++edges % EDGES_PER_POLL == 0)
      progress.reach (pushed - std::min (pushed, stack_.size ()));
    const MeshEdge e = stack_.back ();
    stack_.pop_back ();
    const double change_by_flip = changeByFlip (e);
    if (change_by_flip >= 0.0)
      continue;
    const MeshEdge m = mesh_.mate (e);
    mesh_.flip (e);
    ++flips_;
    change += change_by_flip;
    for (const Index t : {e.triangle, m.triangle})
      for (const std::uint8_t side : {std::uint8_t{0}, std::uint8_t{2}})
        if (mesh_.neighbors[t][side] != NONE)
          stack_.push_back ({t, side});
  }
  return change;
}

double
EdgeFlipper::changeByFlip (MeshEdge e) const
{
  const MeshEdge m = mesh_.mate (e);
  if (m.triangle == NONE || !mesh_.isFree (e.triangle) || !mesh_.isFree (m.triangle))
    return 0.0;
  const Index c = mesh_.corner (e), a = mesh_.from (e), b = mesh_.to (e), d = mesh_.corner (m);
  const TriangleCost::Value now_cab = cost_ (c, a, b), now_dba = cost_ (d, b, a);
  const TriangleCost::Value then_cad = cost_ (c, a, d), then_dbc = cost_ (d, b, c);
  const double now = now_cab.cost + now_dba.cost;
  const double then = then_cad.cost + then_dbc.cost;
  if (then >= now && now_cab.unit_normal.dot (now_dba.unit_normal) >= 0.0)
    return 0.0;
  // Normals across the other edges of the two triangles.
  const auto across = [this] (Index t, std::uint8_t side) {
    return normalAcross (mesh_, cost_, {t, side});
  };
  const Eigen::Vector3d at_bc = across (e.triangle, TriangleMesh::next (e.side));
  const Eigen::Vector3d at_ca = across (e.triangle, TriangleMesh::previous (e.side));
  const Eigen::Vector3d at_ad = across (m.triangle, TriangleMesh::next (m.side));
  const Eigen::Vector3d at_db = across (m.triangle, TriangleMesh::previous (m.side));
  const auto at_edge = [&plain = cost_.plain ()] (const Eigen::Vector3d& p,
                                                  const Eigen::Vector3d& q) {
    return plain.ofEdge (p, q);
  };
  const double total = now + at_edge (now_cab.unit_normal, now_dba.unit_normal) +
                       at_edge (at_bc, now_cab.unit_normal) + at_edge (at_ca, now_cab.unit_normal) +
                       at_edge (at_ad, now_dba.unit_normal) + at_edge (at_db, now_dba.unit_normal);
  const double total_then =
      then + at_edge (then_cad.unit_normal, then_dbc.unit_normal) +
      at_edge (at_bc, then_dbc.unit_normal) + at_edge (at_ca, then_cad.unit_normal) +
      at_edge (at_ad, then_cad.unit_normal) + at_edge (at_db, then_dbc.unit_normal);
  if (total_then >= total - IMPROVES * std::abs (total) || mesh_.hasEdge (c, d))
    return 0.0;
  return total_then - total;
}

namespace {
// Flips the edges chosen by `is_chosen`, and others as a consequence.
template <typename IsChosen>
std::size_t
flipChosen (TriangleMesh& mesh, const TriangleCost& cost, const RunContext& run,
            const IsChosen& is_chosen)
{
  CachedCost cached (cost);
  EdgeFlipper flipper (mesh, cached, run);
  for (auto t = static_cast<Index> (mesh.triangles.size ()); t-- > 0;)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index u = mesh.neighbors[t][side];
      if (u != NONE && t < u && is_chosen (t, u))
        flipper.push ({t, side});
    }
  flipper.run ();
  return flipper.flips ();
}
} // namespace

std::size_t
flipEdges (TriangleMesh& mesh, const TriangleCost& cost, const RunContext& run)
{
  const auto isAny = [] (Index, Index) { return true; };
  if (!mesh.is_fixed.empty () || !mesh.is_partial.empty ())
    return flipChosen (mesh, cost, run, isAny);
  const MeshBlocks blocks (mesh, run);
  if (blocks.count () <= 1)
    return flipChosen (mesh, cost, run, isAny);
  // Triangles of one block, away from its ends.
  std::vector<std::uint8_t> is_free (mesh.triangles.size ());
  parallelRanges (run, is_free.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t)
      is_free[t] = blocks.isFree (mesh, static_cast<Index> (t)) ? 1 : 0;
  });
  std::atomic<std::size_t> flips{0};
  parallelTasks (run, blocks.count (), [&] (std::size_t b) {
    MeshBlock block = blocks.cutOut (mesh, b);
    flips += flipChosen (block.mesh, cost.countedFrom (block.first), run.withThreads (1), isAny);
    blocks.putBack (block, b, mesh);
  });
  // The free triangles have changed, but not which ones are free.
  return flips + flipChosen (mesh, cost, run,
                             [&] (Index t, Index u) { return is_free[t] == 0 || is_free[u] == 0; });
}

} // namespace pcl::floater
