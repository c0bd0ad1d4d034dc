// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/flips.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double TURNED = 0.2; // cosine to the corners' normals below which a triangle is penalized
constexpr double PENALTY = 1000.0;   // per unit of that cosine; a right isosceles triangle costs 2
constexpr double LARGE = 3.0;        // doubled area, in squared spacings, that is not penalized
constexpr double LARGE_COST = 100.0; // per squared spacing beyond
constexpr double IMPROVES =
    1e-9; // relative gain below which the diagonals of a quad count as equal

} // namespace

double
TriangleCost::operator() (Index a, Index b, Index c) const
{
  // The smallest point first, so that the cost of a triangle does not depend, not even by rounding,
  // on where it begins: flips could go round in circles otherwise.
  if (b < a && b < c)
    return (*this) (b, c, a);
  if (c < a && c < b)
    return (*this) (c, a, b);
  const Eigen::Vector3d ab = positions_[b] - positions_[a];
  const Eigen::Vector3d ac = positions_[c] - positions_[a];
  const Eigen::Vector3d bc = positions_[c] - positions_[b];
  const Eigen::Vector3d area_vector = ab.cross (ac);
  const double double_area = area_vector.norm ();
  const double sqr_lengths = ab.squaredNorm () + ac.squaredNorm () + bc.squaredNorm ();
  // cot A + cot B + cot C = (a^2 + b^2 + c^2) / (4 area); bounded, so that costs of needles
  // compare.
  const double cotangents = sqr_lengths / (2.0 * std::max (double_area, 1e-9 * sqr_lengths));
  const double turned = PENALTY * std::max (0.0, TURNED - agreement (a, b, c, area_vector));
  if (spacing_ == nullptr)
    return cotangents + turned;
  const double spacing = ((*spacing_)[a] + (*spacing_)[b] + (*spacing_)[c]) / 3.0;
  return cotangents + turned +
         LARGE_COST * std::max (0.0, double_area / (spacing * spacing) - LARGE);
}

double
TriangleCost::agreement (Index a, Index b, Index c, const Eigen::Vector3d& area_vector) const
{
  const Eigen::Vector3f normal = normals_[a] + normals_[b] + normals_[c];
  const double length = normal.norm () * area_vector.norm ();
  return length > 0.0 ? normal.cast<double> ().dot (area_vector) / length : 0.0;
}

bool
TriangleCost::isTurned (const Triangle& corners) const
{
  const auto [a, b, c] = corners;
  return agreement (a, b, c,
                    (positions_[b] - positions_[a]).cross (positions_[c] - positions_[a])) < TURNED;
}

Eigen::Vector3d
TriangleCost::unitNormal (Index a, Index b, Index c) const
{
  if (b < a && b < c)
    return unitNormal (b, c, a);
  if (c < a && c < b)
    return unitNormal (c, a, b);
  return (positions_[b] - positions_[a]).cross (positions_[c] - positions_[a]).normalized ();
}

void
orientNormals (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               std::vector<Eigen::Vector3f>& normals)
{
  std::vector<Eigen::Vector3f> area (normals.size (), Eigen::Vector3f::Zero ());
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3f area_vector = (positions[t[1]] - positions[t[0]])
                                            .cross (positions[t[2]] - positions[t[0]])
                                            .cast<float> ();
    for (Index p : t)
      area[p] += area_vector;
  }
  for (std::size_t p = 0; p < normals.size (); ++p)
    if (normals[p].dot (area[p]) < 0.0F)
      normals[p] = -normals[p];
}

double
meshCost (const SurfaceMesh& mesh, const TriangleCost& cost)
{
  double sum = 0.0;
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    const Eigen::Vector3d normal = cost.unitNormal (mesh.triangles[t]);
    sum += cost (mesh.triangles[t]);
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] != NONE && t < mesh.neighbors[t][side])
        sum += edgeCost (mesh, cost, {t, side}, normal);
  }
  return sum;
}

double
splitCost (const SurfaceMesh& mesh, const TriangleCost& cost, Index t, Index p)
{
  const auto [a, b, c] = mesh.triangles[t];
  const Eigen::Vector3d whole = cost.unitNormal (a, b, c);
  const std::array<Eigen::Vector3d, 3> part{cost.unitNormal (p, b, c), cost.unitNormal (p, c, a),
                                            cost.unitNormal (p, a, b)};
  double added = cost (p, b, c) + cost (p, c, a) + cost (p, a, b) - cost (a, b, c);
  for (std::uint8_t side = 0; side < 3; ++side)
    added += TriangleCost::ofFold (part[side], part[SurfaceMesh::next (side)]) +
             edgeCost (mesh, cost, {t, side}, part[side]) - edgeCost (mesh, cost, {t, side}, whole);
  return added;
}

double
EdgeFlipper::run ()
{
  double change = 0.0;
  while (!stack_.empty ()) {
    const MeshEdge e = stack_.back ();
    stack_.pop_back ();
    const double gained = gain (e);
    if (gained >= 0.0)
      continue;
    const MeshEdge m = mesh_.mate (e);
    mesh_.flip (e);
    ++flips_;
    change += gained;
    for (const Index t : {e.triangle, m.triangle})
      for (const std::uint8_t side : {std::uint8_t{0}, std::uint8_t{2}})
        if (mesh_.neighbors[t][side] != NONE)
          stack_.push_back ({t, side});
  }
  return change;
}

double
EdgeFlipper::gain (MeshEdge e) const
{
  const MeshEdge m = mesh_.mate (e);
  if (m.triangle == NONE)
    return 0.0;
  const Index c = mesh_.corner (e), a = mesh_.from (e), b = mesh_.to (e), d = mesh_.corner (m);
  const double now = cost_ (c, a, b) + cost_ (d, b, a);
  const double then = cost_ (c, a, d) + cost_ (d, b, c);
  const Eigen::Vector3d now_cab = cost_.unitNormal (c, a, b), now_dba = cost_.unitNormal (d, b, a);
  if (then >= now && now_cab.dot (now_dba) >= 0.0)
    return 0.0;
  const Eigen::Vector3d then_cad = cost_.unitNormal (c, a, d),
                        then_dbc = cost_.unitNormal (d, b, c);
  const MeshEdge bc{e.triangle, SurfaceMesh::next (e.side)},
      ca{e.triangle, SurfaceMesh::previous (e.side)}, ad{m.triangle, SurfaceMesh::next (m.side)},
      db{m.triangle, SurfaceMesh::previous (m.side)};
  const auto edge = [this] (MeshEdge outer, const Eigen::Vector3d& normal) {
    return edgeCost (mesh_, cost_, outer, normal);
  };
  const double total = now + TriangleCost::ofFold (now_cab, now_dba) + edge (bc, now_cab) +
                       edge (ca, now_cab) + edge (ad, now_dba) + edge (db, now_dba);
  const double total_then = then + TriangleCost::ofFold (then_cad, then_dbc) + edge (bc, then_dbc) +
                            edge (ca, then_cad) + edge (ad, then_cad) + edge (db, then_dbc);
  if (total_then >= total - IMPROVES * std::abs (total) || mesh_.hasEdge (c, d))
    return 0.0;
  return total_then - total;
}

std::size_t
flipEdges (SurfaceMesh& mesh, const TriangleCost& cost)
{
  EdgeFlipper flipper (mesh, cost);
  for (auto t = static_cast<Index> (mesh.triangles.size ()); t-- > 0;)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] != NONE && t < mesh.neighbors[t][side])
        flipper.push ({t, side});
  flipper.run ();
  return flipper.flips ();
}

} // namespace floater
} // namespace pcl
