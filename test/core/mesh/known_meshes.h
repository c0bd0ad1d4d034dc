// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Small meshes of known topology, and what is expected of any mesh.
#pragma once

#include "core/geometry.h"
#include "mesh/check.h"
#include "samples.h"

#include <gtest/gtest.h>

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

/// The triangles in the same order, with their neighbours. The calling test fails if they are no
/// oriented manifold.
inline TriangleMesh
connected (const Triangles& triangles, std::size_t points)
{
  TriangleMesh result;
  result.triangles = triangles;
  EXPECT_TRUE (result.connect (points, 1));
  return result;
}

inline TriangleMesh
connected (const Mesh& mesh)
{
  return connected (mesh.triangles, mesh.positions.size ());
}

inline MeshExamination
check (const Mesh& mesh, float spacing = 0.1F)
{
  return checkMesh (connected (mesh), pointsAt (mesh.positions),
                    std::vector<float> (mesh.positions.size (), spacing), 1);
}

/// Expects an oriented manifold with the neighbours that connect () finds, and one of its triangles
/// for every vertex.
inline void
expectConsistent (const TriangleMesh& mesh)
{
  const TriangleMesh fresh = connected (mesh.triangles, mesh.triangle_of.size ());
  EXPECT_EQ (mesh.neighbors, fresh.neighbors);
  for (Index p = 0; p < mesh.triangle_of.size (); ++p) {
    ASSERT_EQ (mesh.triangle_of[p] == NONE, fresh.triangle_of[p] == NONE);
    if (mesh.triangle_of[p] != NONE) {
      const Triangle& t = mesh.triangles[mesh.triangle_of[p]];
      EXPECT_EQ (std::count (t.begin (), t.end (), p), 1);
    }
  }
  EXPECT_TRUE (topologyOf (mesh.triangles).manifold);
}

/// Expects the same triangles in the same places, with the same neighbours.
inline void
expectSame (const TriangleMesh& mesh, const TriangleMesh& expected)
{
  EXPECT_TRUE (mesh.triangles == expected.triangles);
  EXPECT_TRUE (mesh.neighbors == expected.neighbors);
  EXPECT_TRUE (mesh.triangle_of == expected.triangle_of);
}

/// Expects a consistent disc, and returns its boundary.
inline std::vector<Index>
expectDisc (const TriangleMesh& mesh, std::size_t vertices)
{
  expectConsistent (mesh);
  const MeshTopology topology = expectTopology (mesh.triangles, vertices, 1, 1, 1);
  return topology.loops.empty () ? std::vector<Index> () : topology.loops.front ();
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

/// A grid whose points are row by row. \param wraps the last column is the first one
inline Mesh
cells (Index columns, Index rows, const std::function<Eigen::Vector3d (Index, Index)>& place,
       bool wraps = false)
{
  const Index width = wraps ? columns : columns + 1;
  return grid (
      columns, rows, width * (rows + 1),
      [width] (Index x, Index y) { return y * width + x % width; }, place);
}

inline Mesh
sheet (Index side)
{
  return cells (side, side,
                [] (Index x, Index y) { return Eigen::Vector3d (0.1 * x, 0.1 * y, 0.0); });
}

/// \param noise of the heights, a standard deviation
inline Mesh
noisySheet (Index side, double noise, std::uint64_t seed)
{
  Mesh mesh = sheet (side);
  RandomStream random (seed);
  for (Eigen::Vector3d& p : mesh.positions)
    p.z () = noise * random.normal ();
  return mesh;
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
  return cells (
      around, 4,
      [=] (Index x, Index y) {
        const double u = 2.0 * PI * x / around, r = 1.0 - 0.125 * y;
        return Eigen::Vector3d (r * std::cos (u), r * std::sin (u), 0.0);
      },
      true);
}

inline Mesh
tetrahedron (double size = 1.0)
{
  return {{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

inline void
append (Mesh& mesh, const Mesh& more, const Eigen::Vector3d& shift = Eigen::Vector3d::Zero ())
{
  const auto first = static_cast<Index> (mesh.positions.size ());
  for (const Eigen::Vector3d& p : more.positions)
    mesh.positions.emplace_back (p + shift);
  for (const Triangle& t : more.triangles)
    mesh.triangles.push_back ({t[0] + first, t[1] + first, t[2] + first});
}

/// Both meshes, side by side.
inline Mesh
beside (Mesh a, const Mesh& b)
{
  append (a, b, {5.0, 0.0, 0.0});
  return a;
}

/// Front becomes back.
inline void
turnRound (Mesh& mesh)
{
  for (Triangle& t : mesh.triangles)
    std::swap (t[1], t[2]);
}

/// Makes two vertices change places in the mesh, but not in space.
inline void
exchange (TriangleMesh& mesh, Index p, Index q)
{
  for (Triangle& t : mesh.triangles)
    for (Index& corner : t)
      corner = corner == p ? q : corner == q ? p : corner;
  EXPECT_TRUE (mesh.connect (mesh.triangle_of.size (), 1));
}

/// A jittered sheet above another one, both with their fronts above; the points of the upper one
/// are the second half.
struct TwoSheets
{
  Positions positions;
  std::vector<Eigen::Vector3f> normals;
  CsrLists neighbors; ///< the nearest of each point
  TriangleMesh mesh;

  TwoSheets (Mesh lower, const Mesh& upper, int nearest)
  {
    append (lower, upper);
    mesh = connected (lower);
    positions = lower.positions;
    normals.assign (positions.size (), Eigen::Vector3f::UnitZ ());
    neighbors = nearestOf (positions, nearest);
  }
};

} // namespace pcl::floater::samples
