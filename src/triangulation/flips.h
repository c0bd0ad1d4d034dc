// SPDX-License-Identifier: GPL-3.0-or-later
// Edge flips on the surface after lifting.
#pragma once

#include "common/monitor.h"
#include "triangulation/surface_mesh.h"
#include "triangulation/triangle_cost.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Gives every normal the sign for which most of the area around its point faces along it.
void
orientNormals (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               std::vector<Eigen::Vector3f>& normals);

/// Unit normal of the triangle behind a side; zero at the boundary, where nothing is folded.
inline Eigen::Vector3d
normalBehind (const SurfaceMesh& mesh, RememberedCost& cost, MeshEdge e)
{
  const Index other = mesh.neighbors[e.triangle][e.side];
  return other == NONE ? Eigen::Vector3d (Eigen::Vector3d::Zero ())
                       : cost (mesh.triangles[other]).unit_normal;
}

/// Cost of all triangles and edges of a mesh. O(n).
double
meshCost (const SurfaceMesh& mesh, const TriangleCost& cost);

/// Cost that the split of triangle t at point p would add, that of the edges included; if it is
/// above the limit, anything above the limit.
double
splitCost (const SurfaceMesh& mesh, RememberedCost& cost, Index t, Index p, double limit);

/// Flips edges from a stack until none of them, nor of those around the flipped ones, gains. Each
/// flip lowers the cost of the mesh: that of its two triangles and of their five edges.
class EdgeFlipper
{
public:
  EdgeFlipper (SurfaceMesh& mesh, RememberedCost& cost) : mesh_ (mesh), cost_ (cost) {}

  void push (MeshEdge e) { stack_.push_back (e); }

  /// \return by how much the cost of the mesh has changed: 0 or less
  double run ();

  std::size_t flips () const { return flips_; }

private:
  // Change of cost by the flip of an edge; 0 if it cannot be flipped or gains nothing.
  double gain (MeshEdge e) const;

  SurfaceMesh& mesh_;
  RememberedCost& cost_;
  std::vector<MeshEdge> stack_;
  std::size_t flips_ = 0;
};

/// Flips edges of the whole mesh. Boundary edges stay. O(n) in practice.
/// \return number of flips
std::size_t
flipEdges (SurfaceMesh& mesh, const TriangleCost& cost);

} // namespace floater
} // namespace pcl
