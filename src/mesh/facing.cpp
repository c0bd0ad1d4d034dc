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
// Least volume of an open component, closed over its rim from its middle, that tells an inside from
// an outside: as a share of what it would be if all of it faced straight away from there. A half
// sphere has 0.8, a round bowl that is half as deep as that 0.5, a volcano 0.25, terrain less.
constexpr double HAS_INSIDE = 0.3;
constexpr double ALIKE = 0.9; // lengths along two axes, relative

// Sums over the triangles of a component.
struct Component
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero (); // first times the area
  Eigen::Vector3d area_vector = Eigen::Vector3d::Zero ();
  double area = 0.0;
  double volume = 0.0;         // six times that of the pyramids from the middle to all triangles
  double largest_volume = 0.0; // if all faced away from the middle
  bool is_closed = true;
};

Eigen::Vector3d
threeCentroids (const Triangle& t, const std::vector<Eigen::Vector3d>& positions)
{
  return positions[t[0]] + positions[t[1]] + positions[t[2]];
}

std::vector<Component>
measureComponents (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                   const MeshComponents& found)
{
  std::vector<Component> components (found.count);
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    Component& component = components[found.of_triangle[t]];
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d area_vector = areaVector (positions[a], positions[b], positions[c]);
    const double area = area_vector.norm ();
    component.middle += area / 3.0 * threeCentroids (mesh.triangles[t], positions);
    component.area_vector += area_vector;
    component.area += area;
    for (const Index u : mesh.neighbors[t])
      component.is_closed = component.is_closed && u != NONE;
  }
  for (Component& component : components)
    if (component.area > 0.0)
      component.middle /= component.area;
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    Component& component = components[found.of_triangle[t]];
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d area_vector = areaVector (positions[a], positions[b], positions[c]);
    const Eigen::Vector3d away =
        threeCentroids (mesh.triangles[t], positions) / 3.0 - component.middle;
    component.volume += away.dot (area_vector);
    component.largest_volume += away.norm () * area_vector.norm ();
  }
  return components;
}

bool
facesDown (const Eigen::Vector3d& normal)
{
  const double longest = normal.cwiseAbs ().maxCoeff ();
  for (const int axis : {2, 1})
    if (std::abs (normal[axis]) >= ALIKE * longest)
      return normal[axis] < 0.0;
  return normal.x () < 0.0;
}

bool
facesInwards (const Component& component)
{
  if (component.is_closed || std::abs (component.volume) >= HAS_INSIDE * component.largest_volume)
    return component.volume < 0.0;
  return facesDown (component.area_vector);
}

} // namespace

std::size_t
faceOutwards (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions)
{
  const MeshComponents found = findComponents (mesh);
  const std::vector<Component> components = measureComponents (mesh, positions, found);
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    if (facesInwards (components[found.of_triangle[t]])) {
      std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
      std::swap (mesh.neighbors[t][1], mesh.neighbors[t][2]);
    }
  return static_cast<std::size_t> (
      std::count_if (components.begin (), components.end (), facesInwards));
}

} // namespace floater
} // namespace pcl
