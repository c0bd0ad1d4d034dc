// SPDX-License-Identifier: GPL-3.0-or-later
// Edge flips on the surface after lifting.
#pragma once

#include "core/run_context.h"
#include "mesh/triangle_cost.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Gives every normal the sign for which most of the area around its point faces along it.
void
orientNormals (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               std::vector<Eigen::Vector3f>& normals, const RunContext& run);

/// Unit normal of the triangle behind a side; zero at the boundary, where nothing is folded.
inline Eigen::Vector3d
normalBehind (const TriangleMesh& mesh, CachedCost& cost, MeshEdge e)
{
  const Index other = mesh.neighbors[e.triangle][e.side];
  return other == NONE ? Eigen::Vector3d (Eigen::Vector3d::Zero ())
                       : cost (mesh.triangles[other]).unit_normal;
}

/// Cost of all triangles and edges of a mesh. O(n).
double
meshCost (const TriangleMesh& mesh, const TriangleCost& cost, const RunContext& run);

/// Cost that the split of triangle t at point p would add, that of the edges included; if it is
/// above the limit, anything above the limit.
double
splitCost (const TriangleMesh& mesh, CachedCost& cost, Index t, Index p, double limit);

/// Flips edges from a stack until none of them, nor of those around the flipped ones, gains. Each
/// flip lowers the cost of the mesh: that of its two triangles and of their five edges.
class EdgeFlipper
{
public:
  EdgeFlipper (TriangleMesh& mesh, CachedCost& cost, const RunContext& run)
      : mesh_ (mesh), cost_ (cost), run_ (run)
  {
  }

  void push (MeshEdge e) { stack_.push_back (e); }

  /// \return by how much the cost of the mesh has changed: 0 or less
  double run ();

  std::size_t flips () const { return flips_; }

private:
  // Change of cost by the flip of an edge; 0 if it cannot be flipped or gains nothing.
  double gain (MeshEdge e) const;

  TriangleMesh& mesh_;
  CachedCost& cost_;
  RunContext run_;
  std::vector<MeshEdge> stack_;
  std::size_t flips_ = 0;
};

/// Flips edges of the whole mesh. Boundary edges stay. O(n) in practice.
/// \return number of flips
std::size_t
flipEdges (TriangleMesh& mesh, const TriangleCost& cost, const RunContext& run);

} // namespace floater
} // namespace pcl
