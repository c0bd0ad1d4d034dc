// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Small meshes of known topology, and what is expected of any mesh; and large ones of which it is known how they face.
#pragma once

#include "core/geometry.h"
#include "mesh/check.h"
#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

#include <array>
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
        return polar (1.0 + 0.4 * std::cos (v), u, 0.4 * std::sin (v));
      });
}

/// A ring of `around` cells between radius 0.5 and 1.
inline Mesh
annulus (Index around)
{
  return cells (
      around, 4, [=] (Index x, Index y) { return polar (1.0 - 0.125 * y, 2.0 * PI * x / around); },
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
beside (Mesh a, const Mesh& b, const Eigen::Vector3d& shift = {5.0, 0.0, 0.0})
{
  append (a, b, shift);
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

/// A mesh whose points have normals upwards, and its boundary loops.
struct UprightMesh
{
  Positions positions;
  std::vector<Eigen::Vector3f> normals;
  TriangleMesh mesh;
  std::vector<BoundaryLoop> loops;

  explicit UprightMesh (const Mesh& made)
      : positions (made.positions), normals (positions.size (), Eigen::Vector3f::UnitZ ()),
        mesh (connected (made)),
        loops (findBoundaryLoops (mesh, findComponents (mesh, 1), positions,
                                  std::vector<float> (positions.size (), 0.1F), 1))
  {
  }
};

/// A jittered sheet above another one, both with their fronts above; the points of the upper one
/// are the second half.
struct TwoSheets : UprightMesh
{
  CsrLists neighbors; ///< the nearest of each point

  TwoSheets (const Mesh& lower, const Mesh& upper, int nearest)
      : UprightMesh (beside (lower, upper, {0.0, 0.0, 0.0})),
        neighbors (nearestOf (positions, nearest))
  {
  }
};

} // namespace pcl::floater::samples

// Generated meshes of which it is known how they should face: thousands of triangles, bent and turned at random.
namespace pcl::floater::facing_cases {
using samples::between;
using samples::Mesh;
using Vector = Eigen::Vector3d;

inline Index
upTo (std::size_t most, RandomStream& random)
{
  return static_cast<Index> (1 + random.below (most));
}

/// Bends space, by so little that nothing crosses, and turns it.
inline void
bendAtRandom (Mesh& mesh, RandomStream& random)
{
  const auto direction = [&random] { return samples::normalVector (random).normalized (); };
  for (int wave = 0; wave < 3; ++wave) {
    const Vector along = between (random, 1.0, 4.0) * direction ();
    const Vector shift = 0.25 / along.norm () * direction ();
    const double phase = between (random, 0.0, 2.0 * PI);
    for (Vector& p : mesh.positions)
      p += std::sin (along.dot (p) + phase) * shift;
  }
  const Eigen::Quaterniond rotation (random.normal (), random.normal (), random.normal (),
                                     random.normal ());
  for (Vector& p : mesh.positions)
    p = rotation.normalized () * p;
}

constexpr Index AROUND = 80, ACROSS = 30; ///< cells of a torus

/// A torus with the radii 1 and `tube`.
inline Mesh
ring (double tube)
{
  Mesh mesh = samples::torus (AROUND, ACROSS);
  for (Vector& p : mesh.positions) {
    const Vector middle = Vector (p.x (), p.y (), 0.0).normalized ();
    p = middle + tube / 0.4 * (p - middle);
  }
  return mesh;
}

/// A cap around -z of the unit sphere, open at the top, of 2 side^2 triangles. The front is
/// outside.
inline Mesh
makeBowl (double share_of_area, Index side = 30)
{
  const double end = std::acos (1.0 - 2.0 * share_of_area);
  return samples::cells (side, side, [=] (Index column, Index row) {
    const double x = 2.0 * column / side - 1.0, y = 2.0 * row / side - 1.0;
    const Eigen::Vector2d disc (y * std::sqrt (1.0 - 0.5 * x * x),
                                x * std::sqrt (1.0 - 0.5 * y * y));
    const double angle = end * disc.norm ();
    const Eigen::Vector2d around = disc.norm () > 0.0 ? disc.normalized () : disc;
    return Vector (around.x () * std::sin (angle), around.y () * std::sin (angle),
                   -std::cos (angle));
  });
}

/// Takes cells, of two triangles each, out of a grid of so many columns.
inline void
takeOut (Mesh& mesh, Index columns, const std::function<bool (Index, Index)>& is_out)
{
  samples::Triangles left;
  left.reserve (mesh.triangles.size ());
  for (std::size_t t = 0; t < mesh.triangles.size (); ++t) {
    const auto cell = static_cast<Index> (t / 2);
    if (!is_out (cell % columns, cell / columns))
      left.push_back (mesh.triangles[t]);
  }
  mesh.triangles = left;
}

/// Cuts rectangular windows into a torus, each in some columns of its own.
inline void
cutWindows (Mesh& mesh, Index windows, RandomStream& random)
{
  std::vector<bool> is_out (AROUND * ACROSS, false);
  for (Index window = 0; window < windows; ++window) {
    const Index first = AROUND / windows * window, low = upTo (ACROSS, random);
    const Index width = 2 + upTo (4, random), height = 2 + upTo (8, random);
    for (Index x = 0; x < width; ++x)
      for (Index y = 0; y < height; ++y)
        is_out[first + x + AROUND * ((low + y) % ACROSS)] = true;
  }
  takeOut (mesh, AROUND, [&] (Index x, Index y) { return is_out[x + AROUND * y]; });
}

struct Family
{
  const char* name;
  Mesh (*make) (RandomStream&);
};

constexpr std::array<Family, 4> FAMILIES{{
    {"winged body", // flat, with a handle and 1 to 10 windows
     [] (RandomStream& random) {
       Mesh mesh = ring (between (random, 0.15, 0.5));
       const double flatness = between (random, 0.3, 1.0);
       for (Vector& p : mesh.positions)
         p.z () *= flatness;
       cutWindows (mesh, upTo (10, random), random);
       return mesh;
     }},
    {"nested bodies", // closed, solid and hollow in turns, and one beside them; walls may be thin
     [] (RandomStream& random) {
       Mesh all;
       double tube = 0.45;
       const Index depth = 1 + upTo (3, random);
       for (Index i = 0; i < depth; ++i) {
         Mesh mesh = ring (tube);
         if (i % 2 == 1)
           samples::turnRound (mesh);
         samples::append (all, mesh);
         tube *= between (random, 0.4, 0.9);
       }
       samples::append (all, ring (0.3), 4.0 * Vector::UnitX ());
       return all;
     }},
    {"body in shell", // closed, in another one that has windows
     [] (RandomStream& random) {
       Mesh outer = ring (0.45);
       cutWindows (outer, upTo (5, random), random);
       samples::append (outer, ring (between (random, 0.1, 0.3)));
       return outer;
     }},
    {"torn body", // nearly a sphere, in pieces
     [] (RandomStream& random) {
       constexpr Index SIDE = 50;
       Mesh mesh = makeBowl (0.97, SIDE);
       const Index width = upTo (4, random), tears = upTo (4, random), row = upTo (SIDE, random);
       takeOut (mesh, SIDE, [=] (Index x, Index y) {
         return x % (SIDE / tears) < width || (y + row) % SIDE < width;
       });
       return mesh;
     }},
}};

/// A mesh that faces as it should; the same for the same seed.
inline Mesh
makeFacingCase (const Family& family, std::uint64_t seed)
{
  RandomStream random (seed);
  Mesh mesh = family.make (random);
  bendAtRandom (mesh, random);
  return mesh;
}

} // namespace pcl::floater::facing_cases
