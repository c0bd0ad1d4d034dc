// SPDX-License-Identifier: GPL-3.0-or-later
// Edge flips on the surface after lifting.
#pragma once

#include "triangulation/surface_mesh.h"

#include <algorithm>
#include <vector>

namespace pcl
{
namespace floater
{
/// How bad a triangle is: the sum of the cotangents of its angles, which Delaunay flips minimize in
/// the plane, and penalties where it is turned away from the normals of its corners, or larger than
/// triangles between neighbours are: where sheets are near, that tells the wrong one.
class TriangleCost
{
public:
  /// \param normals oriented like the mesh (see orientNormals)
  /// \param spacing of each point (see localSpacing); nullptr: large triangles cost no more
  TriangleCost (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Eigen::Vector3f>& normals,
                const std::vector<float>* spacing = nullptr)
      : positions_ (positions), normals_ (normals), spacing_ (spacing)
  {
  }

  double operator() (Index a, Index b, Index c) const;
  double operator() (const Triangle& corners) const
  {
    return (*this) (corners[0], corners[1], corners[2]);
  }

  /// True if a triangle is penalized for its direction.
  bool isTurned (const Triangle& corners) const;

  /// Cost of an edge between two triangles: nothing up to a right angle, then it grows.
  static double ofFold (const Eigen::Vector3d& unit_normal,
                        const Eigen::Vector3d& other_unit_normal)
  {
    return FOLD_COST * std::max (0.0, -unit_normal.dot (other_unit_normal));
  }

  Eigen::Vector3d unitNormal (Index a, Index b, Index c) const;
  Eigen::Vector3d unitNormal (const Triangle& corners) const
  {
    return unitNormal (corners[0], corners[1], corners[2]);
  }

private:
  // Cosine between the area vector and the sum of the corners' normals; 0 without area.
  double agreement (Index a, Index b, Index c, const Eigen::Vector3d& area_vector) const;

  static constexpr double FOLD_COST = 1000.0; // per unit of negative cosine

  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<Eigen::Vector3f>& normals_;
  const std::vector<float>* spacing_;
};

/// Gives every normal the sign for which most of the area around its point faces along it.
void
orientNormals (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               std::vector<Eigen::Vector3f>& normals);

/// Cost of the edge between a triangle and what is behind one of its sides; 0 at the boundary.
inline double
edgeCost (const SurfaceMesh& mesh, const TriangleCost& cost, MeshEdge e,
          const Eigen::Vector3d& unit_normal)
{
  const Index other = mesh.neighbors[e.triangle][e.side];
  return other == NONE
             ? 0.0
             : TriangleCost::ofFold (unit_normal, cost.unitNormal (mesh.triangles[other]));
}

/// Cost of all triangles and edges of a mesh. O(n).
double
meshCost (const SurfaceMesh& mesh, const TriangleCost& cost);

/// Cost that the split of triangle t at point p would add, that of the edges included.
double
splitCost (const SurfaceMesh& mesh, const TriangleCost& cost, Index t, Index p);

/// Flips edges from a stack until none of them, nor of those around the flipped ones, gains. Each
/// flip lowers the cost of the mesh: that of its two triangles and of their five edges.
class EdgeFlipper
{
public:
  EdgeFlipper (SurfaceMesh& mesh, const TriangleCost& cost) : mesh_ (mesh), cost_ (cost) {}

  void push (MeshEdge e) { stack_.push_back (e); }

  /// \return by how much the cost of the mesh has changed: 0 or less
  double run ();

  std::size_t flips () const { return flips_; }

private:
  // Change of cost by the flip of an edge; 0 if it cannot be flipped or gains nothing.
  double gain (MeshEdge e) const;

  SurfaceMesh& mesh_;
  const TriangleCost& cost_;
  std::vector<MeshEdge> stack_;
  std::size_t flips_ = 0;
};

/// Flips edges of the whole mesh. Boundary edges stay. O(n) in practice.
/// \return number of flips
std::size_t
flipEdges (SurfaceMesh& mesh, const TriangleCost& cost);

} // namespace floater
} // namespace pcl
