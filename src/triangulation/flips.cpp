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
constexpr double TURNED = 0.4; // cosine to the corners' normals below which a triangle is penalized
constexpr double PENALTY = 1000.0; // per unit of that cosine; a right isosceles triangle costs 2
constexpr double IMPROVES =
    1e-9; // relative gain below which the diagonals of a quad count as equal

// Flips from a stack of edges; the mesh stays a manifold throughout.
class Flipper
{
public:
  Flipper (SurfaceMesh& mesh, const TriangleCost& cost,
           const std::function<bool (Index, Index)>& allowed)
      : mesh_ (mesh), cost_ (cost), allowed_ (allowed)
  {
    for (auto t = static_cast<Index> (mesh.triangles.size ()); t-- > 0;)
      for (std::uint8_t side = 0; side < 3; ++side)
        if (mesh.neighbors[t][side] != NONE && t < mesh.neighbors[t][side])
          stack_.push_back ({t, side});
  }

  std::size_t run ()
  {
    std::size_t flips = 0;
    while (!stack_.empty ()) {
      const MeshEdge e = stack_.back ();
      stack_.pop_back ();
      if (!improves (e))
        continue;
      const MeshEdge m = mesh_.mate (e);
      mesh_.flip (e);
      ++flips;
      for (const Index t : {e.triangle, m.triangle})
        for (const std::uint8_t side : {std::uint8_t{0}, std::uint8_t{2}})
          if (mesh_.neighbors[t][side] != NONE)
            stack_.push_back ({t, side});
    }
    return flips;
  }

private:
  bool improves (MeshEdge e) const
  {
    const MeshEdge m = mesh_.mate (e);
    if (m.triangle == NONE)
      return false;
    const Index c = mesh_.corner (e), a = mesh_.from (e), b = mesh_.to (e), d = mesh_.corner (m);
    const double now = cost_ (c, a, b) + cost_ (d, b, a);
    const double then = cost_ (c, a, d) + cost_ (d, b, c);
    return then < now - IMPROVES * std::abs (now) && !mesh_.hasEdge (c, d) &&
           (!allowed_ || allowed_ (c, d));
  }

  SurfaceMesh& mesh_;
  const TriangleCost& cost_;
  const std::function<bool (Index, Index)>& allowed_;
  std::vector<MeshEdge> stack_;
};

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
  const Eigen::Vector3f normal = normals_[a] + normals_[b] + normals_[c];
  const double length = normal.norm () * double_area;
  const double agreement = length > 0.0 ? normal.cast<double> ().dot (area_vector) / length : 0.0;
  return cotangents + PENALTY * std::max (0.0, TURNED - agreement);
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

std::size_t
flipEdges (SurfaceMesh& mesh, const TriangleCost& cost)
{
  return Flipper (mesh, cost, {}).run ();
}

std::size_t
flipEdges (SurfaceMesh& mesh, const TriangleCost& cost,
           const std::function<bool (Index, Index)>& allowed)
{
  return Flipper (mesh, cost, allowed).run ();
}

} // namespace floater
} // namespace pcl
