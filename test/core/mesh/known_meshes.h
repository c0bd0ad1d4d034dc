// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Small meshes of known topology.
#pragma once

#include "mesh/check.h"
#include "samples.h"

#include <cmath>
#include <functional>
#include <vector>

namespace pcl::floater::samples {
using Triangles = std::vector<Triangle>;

struct Mesh
{
  Positions positions;
  Triangles triangles;
};

/// Points in the order given. They are every third point of a cloud of another scale.
inline Points
pointsAt (const Positions& positions)
{
  Points points;
  points.positions = positions;
  points.centre = {100.0, -20.0, 3.0};
  points.scale = 10.0;
  for (Index p = 0; p < positions.size (); ++p)
    points.cloud_index.push_back (3 * p + 1);
  return points;
}

inline MeshExamination
check (const Mesh& mesh, float spacing = 0.1F, int threads = 1)
{
  return checkMesh (mesh.triangles, pointsAt (mesh.positions),
                    std::vector<float> (mesh.positions.size (), spacing), threads);
}

/// A grid of cells, each cut in two; vertex (x, y) is `index (x, y)` at `place (x, y)`.
inline Mesh
grid (Index columns, Index rows, std::size_t points,
      const std::function<Index (Index, Index)>& index,
      const std::function<Eigen::Vector3d (Index, Index)>& place)
{
  Mesh mesh;
  mesh.positions.resize (points);
  for (Index y = 0; y <= rows; ++y)
    for (Index x = 0; x <= columns; ++x)
      mesh.positions[index (x, y)] = place (x, y);
  for (Index y = 0; y < rows; ++y)
    for (Index x = 0; x < columns; ++x) {
      const Index a = index (x, y), b = index (x + 1, y), c = index (x, y + 1),
                  d = index (x + 1, y + 1);
      mesh.triangles.push_back ({a, b, d});
      mesh.triangles.push_back ({a, d, c});
    }
  return mesh;
}

inline Mesh
sheet (Index side)
{
  return grid (
      side, side, (side + 1) * (side + 1), [side] (Index x, Index y) { return y * (side + 1) + x; },
      [] (Index x, Index y) { return Eigen::Vector3d (0.1 * x, 0.1 * y, 0.0); });
}

inline Mesh
torus (Index around, Index across)
{
  return grid (
      around, across, around * across,
      [=] (Index x, Index y) { return y % across * around + x % around; },
      [=] (Index x, Index y) {
        const double u = 2.0 * PI * x / around, v = 2.0 * PI * y / across;
        return Eigen::Vector3d ((1.0 + 0.4 * std::cos (v)) * std::cos (u),
                                (1.0 + 0.4 * std::cos (v)) * std::sin (u), 0.4 * std::sin (v));
      });
}

/// A ring of `around` cells between radius 0.5 and 1.
inline Mesh
annulus (Index around)
{
  return grid (
      around, 4, 5 * around, [=] (Index x, Index y) { return y * around + x % around; },
      [=] (Index x, Index y) {
        const double u = 2.0 * PI * x / around, r = 1.0 - 0.125 * y;
        return Eigen::Vector3d (r * std::cos (u), r * std::sin (u), 0.0);
      });
}

inline Mesh
tetrahedron (double size = 1.0)
{
  return {{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// Both meshes, side by side.
inline Mesh
beside (Mesh a, const Mesh& b)
{
  const auto first = static_cast<Index> (a.positions.size ());
  for (const Eigen::Vector3d& p : b.positions)
    a.positions.emplace_back (p + Eigen::Vector3d (5.0, 0.0, 0.0));
  for (const Triangle& t : b.triangles)
    a.triangles.push_back ({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

} // namespace pcl::floater::samples
