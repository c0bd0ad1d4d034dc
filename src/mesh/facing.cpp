// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/facing.h"

#include "core/geometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// Sums over the triangles of a component.
struct Component
{
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero ();
  Eigen::Vector3d area_vector = Eigen::Vector3d::Zero ();
  double area = 0.0;   // doubled
  double volume = 0.0; // six times that of the tetrahedra from the centroid to the triangles
  double largest_volume = 0.0; // the same if all triangles faced straight away from the centroid
  bool is_closed = true;
};

Eigen::Vector3d
sumOfCorners (const Triangle& t, const std::vector<Eigen::Vector3d>& positions)
{
  return positions[t[0]] + positions[t[1]] + positions[t[2]];
}

std::vector<Component>
measureComponents (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                   const MeshComponents& found, const RunContext& run)
{
  std::vector<Component> components (found.count);
  ProgressLoop progress (run);
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    progress.next ();
    Component& component = components[found.of_triangle[t]];
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d area_vector = areaVector (positions[a], positions[b], positions[c]);
    const double area = area_vector.norm ();
    component.centroid += area / 3.0 * sumOfCorners (mesh.triangles[t], positions);
    component.area_vector += area_vector;
    component.area += area;
    for (const Index u : mesh.neighbors[t])
      component.is_closed = component.is_closed && u != NONE;
  }
  for (Component& component : components)
    if (component.area > 0.0)
      component.centroid /= component.area;
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    progress.next ();
    Component& component = components[found.of_triangle[t]];
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d area_vector = areaVector (positions[a], positions[b], positions[c]);
    const Eigen::Vector3d away =
        sumOfCorners (mesh.triangles[t], positions) / 3.0 - component.centroid;
    component.volume += away.dot (area_vector);
    component.largest_volume += away.norm () * area_vector.norm ();
  }
  return components;
}

bool
facesDown (const Eigen::Vector3d& normal, const FacingLimits& limits)
{
  const double longest = normal.cwiseAbs ().maxCoeff ();
  for (const int axis : {2, 1})
    if (std::abs (normal[axis]) >= limits.equal_axes * longest)
      return normal[axis] < 0.0;
  return normal.x () < 0.0;
}

bool
facesInwards (const Component& component, const FacingLimits& limits)
{
  if (component.is_closed ||
      std::abs (component.volume) >= limits.inside_share * component.largest_volume)
    return component.volume < 0.0;
  return facesDown (component.area_vector, limits);
}

} // namespace

std::size_t
faceOutwards (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const FacingLimits& limits, const RunContext& run)
{
  const MeshComponents found = findComponents (mesh, run);
  std::vector<std::uint8_t> is_turned;
  for (const Component& component : measureComponents (mesh, positions, found, run))
    is_turned.push_back (facesInwards (component, limits) ? 1 : 0);
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (is_turned[found.of_triangle[t]] != 0) {
      std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
      std::swap (mesh.neighbors[t][1], mesh.neighbors[t][2]);
    }
  return static_cast<std::size_t> (std::count (is_turned.begin (), is_turned.end (), 1));
}

} // namespace floater
} // namespace pcl
