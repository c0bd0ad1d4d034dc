// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view_flips.h"

#include "core/order_statistics.h"
#include "core/parallel.h"

namespace pcl::floater {
namespace {
// Degrees by which the angles opposite to the new edge may exceed 180 in the view. On a raster it
// is 0: both diagonals of a cell are Delaunay.
constexpr double ANGLE = 90.0;
// Cost of a fold; an edge costs 1 - cosine of the angle between its triangles. The largest change
// of cost by an edge without a fold is 1.5, so a fold equals three of these.
constexpr double FOLD_COST = 5.0;
// A smaller change of cost may be rounding.
constexpr double SHORTER = 1e-9;

// An edge costs this by the unit normals of its triangles.
double
costOf (const Vector3d& normal, const Vector3d& other)
{
  return 1.0 - normal.dot (other) + (isFold (normal, other) ? FOLD_COST : 0.0);
}

} // namespace

Flags
findGaps (const TriangleMesh& view, const Rays& rays, const RunContext& run)
{
  // Circumradius of a triangle, over the typical one around it, above which it lies in a gap. A
  // block of 4 by 4 missing rays in a raster has 3.5 times the radius of its cells, one of 5 by 5
  // has 4.2. For random rays, two triangles in a thousand are as large.
  constexpr double RADIUS = 4.0;
  const std::size_t points = view.triangle_of.size ();
  std::vector<float> radii (view.triangles.size ());
  parallelPoints (run, radii.size (), [&] (Index t) {
    const auto& [a, b, c] = view.triangles[t];
    const Vector3d u = rays.directions[b] - rays.directions[a];
    const Vector3d v = rays.directions[c] - rays.directions[a];
    const auto radius = static_cast<float> (circumradius (Vector3d::Zero (), u, v));
    radii[t] = radius >= 0.0F ? radius : std::numeric_limits<float>::infinity ();
  });
  // The second smallest radius around each point, then its median over the neighbours: at a
  // boundary, most triangles may lie in the gap, but hardly fewer than two on the surface.
  std::vector<float> around (points, 0.0F), typical (points, 0.0F);
  parallelPoints<std::vector<Index>, std::vector<float>> (
      run, points, [&] (Index p, auto& fan, auto& values) {
        view.fan (p, fan);
        values.clear ();
        for (const Index t : fan)
          values.push_back (radii[t]);
        if (!fan.empty ())
          around[p] = valueAtRank (values, std::min<std::size_t> (1, fan.size () - 1));
      });
  parallelPoints<std::vector<Index>, std::vector<float>> (
      run, points, [&] (Index p, auto& fan, auto& values) {
        view.fan (p, fan);
        values.clear ();
        for (const Index t : fan)
          for (const Index q : view.triangles[t])
            values.push_back (around[q]);
        if (!fan.empty ())
          typical[p] = median (values);
      });
  Flags is_gap (radii.size (), 0);
  for (std::size_t t = 0; t < radii.size (); ++t) {
    const auto& [a, b, c] = view.triangles[t];
    const double least = std::min ({typical[a], typical[b], typical[c]});
    is_gap[t] = static_cast<double> (radii[t]) > RADIUS * least ? 1 : 0;
  }
  return is_gap;
}

std::size_t
flipInView (TriangleMesh& mesh, const Rays& rays, const Positions& positions, const RunContext& run)
{
  std::vector<Vector3d> normals (mesh.triangles.size ()); // of the triangles, unit length
  const auto normalOf = [&positions] (const Triangle& t) -> Vector3d {
    return areaVectorOf (t, positions).normalized ();
  };
  parallelPoints (run, normals.size (),
                  [&] (Index t) { normals[t] = normalOf (mesh.triangles[t]); });
  // The angle at p from the ray of `from` to that of `to`; nothing unless it is anti-clockwise.
  const auto angle = [&rays] (Index p, Index from, Index to) -> std::optional<double> {
    constexpr double SLIVER = 1e-3;
    const Vector3d u = rays.directions[from] - rays.directions[p];
    const Vector3d v = rays.directions[to] - rays.directions[p];
    const Vector3d towards_sensor = -(rays.from.is_far ? rays.from.place : rays.directions[p]);
    const double sine = u.cross (v).dot (towards_sensor) / (u.norm () * v.norm ());
    if (!(sine > SLIVER))
      return {};
    return std::atan2 (u.cross (v).norm (), u.dot (v));
  };
  const auto costAcross = [&normals] (const Vector3d& normal, Index other) {
    return other == NONE ? 0.0 : costOf (normal, normals[other]);
  };
  // By how much the flip of an inner edge lowers the cost; 0 if it is not allowed or lowers nothing.
  // The edges must form a convex quadrangle in the view, and its other diagonal must be nearly Delaunay.
  const auto gainOfFlip = [&] (MeshEdge e) {
    const MeshEdge m = mesh.mate (e);
    const Index c = mesh.corner (e), a = mesh.from (e), b = mesh.to (e), d = mesh.corner (m);
    const auto across = [&mesh] (MeshEdge edge, std::uint8_t side) {
      return mesh.neighbors[edge.triangle][side];
    };
    const Index bc = across (e, TriangleMesh::next (e.side));
    const Index ca = across (e, TriangleMesh::previous (e.side));
    const Index ad = across (m, TriangleMesh::next (m.side));
    const Index db = across (m, TriangleMesh::previous (m.side));
    const Vector3d &at_c = normals[e.triangle], &at_d = normals[m.triangle];
    const Vector3d at_a = normalOf ({c, a, d}), at_b = normalOf ({d, b, c});
    const double before = costOf (at_c, at_d) + costAcross (at_c, ca) + costAcross (at_c, bc) +
                          costAcross (at_d, ad) + costAcross (at_d, db);
    const double after = costOf (at_a, at_b) + costAcross (at_a, ca) + costAcross (at_a, ad) +
                         costAcross (at_b, bc) + costAcross (at_b, db);
    if (!(after < before - SHORTER))
      return 0.0;
    const std::optional<double> angle_a = angle (a, d, c), angle_b = angle (b, c, d);
    return angle_a && angle_b && *angle_a + *angle_b <= PI + ANGLE * DEGREE ? before - after : 0.0;
  };
  // In rounds: all edges that may be better flipped are tested on all threads, and then flipped, the
  // best ones first, but for those at or beside a triangle that a flip of the same round has changed.
  // In 80 simulated scans this leaves 14 % fewer folds than to follow each flip to those around it.
  using Flip = std::tuple<double, Index, std::uint8_t>; // change of the cost, and the edge
  std::vector<Index> tested = indicesBelow (mesh.triangles.size ());   // whose edges are tested
  Flags is_tested (tested.size (), 1), is_changed (tested.size (), 0); // the latter in this round
  const auto hasChanged = [&is_changed] (Index t) { return t != NONE && is_changed[t] != 0; };
  std::size_t flips = 0;
  while (!tested.empty ()) {
    RangeLists<Flip> ranges (tested.size ());
    parallelRanges (run, tested.size (), [&] (std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        for (std::uint8_t side = 0; side < 3; ++side)
          if (const Index t = tested[i], other = mesh.neighbors[t][side];
              other != NONE && (t < other || is_tested[other] == 0))
            if (const double gain = gainOfFlip ({t, side}); gain > 0.0)
              ranges.of (first).emplace_back (-gain, t, side);
    });
    for (const Index t : tested)
      is_tested[t] = 0;
    std::vector<Flip> found = ranges.join ();
    sortInParallel (found.begin (), found.end (), std::less<> (), run);
    std::vector<Index> changed;
    for (const auto& [change, t, side] : found) {
      const MeshEdge e{t, side};
      const std::array<Index, 2> both{t, mesh.neighbors[t][side]};
      // The other diagonal may be an edge elsewhere, where triangles were removed.
      if (std::any_of (both.begin (), both.end (),
                       [&] (Index one) {
                         const std::array<Index, 3>& beside = mesh.neighbors[one];
                         return hasChanged (one) ||
                                std::any_of (beside.begin (), beside.end (), hasChanged);
                       }) ||
          mesh.hasEdge (mesh.corner (e), mesh.corner (mesh.mate (e))))
        continue;
      mesh.flip (e);
      for (const Index one : both) {
        normals[one] = normalOf (mesh.triangles[one]);
        is_changed[one] = 1;
        changed.push_back (one);
      }
    }
    flips += changed.size () / 2;
    tested = changed;
    for (const Index t : changed) {
      is_changed[t] = 0;
      std::copy_if (mesh.neighbors[t].begin (), mesh.neighbors[t].end (),
                    std::back_inserter (tested), [] (Index beside) { return beside != NONE; });
    }
    sortUnique (tested);
    for (const Index t : tested)
      is_tested[t] = 1;
  }
  return flips;
}

} // namespace pcl::floater
