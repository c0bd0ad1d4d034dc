// SPDX-License-Identifier: GPL-3.0-or-later
// Edge flips on the surface after lifting.
#pragma once

#include "triangulation/surface_mesh.h"

#include <functional>
#include <vector>

namespace pcl
{
namespace floater
{
/// How bad a triangle is: the sum of the cotangents of its angles, which Delaunay flips minimize in
/// the plane, and a penalty where it is turned away from the normals of its corners.
class TriangleCost
{
public:
  /// \param normals oriented like the mesh (see orientNormals)
  TriangleCost (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Eigen::Vector3f>& normals)
      : positions_ (positions), normals_ (normals)
  {
  }

  double operator() (Index a, Index b, Index c) const;
  double operator() (const Triangle& corners) const
  {
    return (*this) (corners[0], corners[1], corners[2]);
  }

private:
  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<Eigen::Vector3f>& normals_;
};

/// Gives every normal the sign for which most of the area around its point faces along it.
void
orientNormals (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               std::vector<Eigen::Vector3f>& normals);

/// Flips every edge whose flip lowers the summed cost of its two triangles, until none is left.
/// Each flip lowers the cost of the mesh, so this ends. Boundary edges stay. O(n) in practice.
/// \return number of flips
std::size_t
flipEdges (SurfaceMesh& mesh, const TriangleCost& cost);

/// The same for a patch of a larger mesh: `allowed (p, q)` tells whether points p and q, not joined
/// in the patch, may become neighbours.
std::size_t
flipEdges (SurfaceMesh& mesh, const TriangleCost& cost,
           const std::function<bool (Index, Index)>& allowed);

} // namespace floater
} // namespace pcl
