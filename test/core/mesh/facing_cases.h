// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Generated meshes of which it is known how they should face: thousands of triangles, bent and turned at random.
#pragma once

#include "known_meshes.h"
#include "surfaces.h"

#include <array>

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
  const auto direction = [&random] {
    return Vector (random.normal (), random.normal (), random.normal ()).normalized ();
  };
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

/// A flat body with a handle and 1 to 10 windows.
inline Mesh
wingedBody (RandomStream& random)
{
  Mesh mesh = ring (between (random, 0.15, 0.5));
  const double flatness = between (random, 0.3, 1.0);
  for (Vector& p : mesh.positions)
    p.z () *= flatness;
  cutWindows (mesh, upTo (10, random), random);
  return mesh;
}

/// Closed bodies within each other, solid and hollow in turns, and one beside them. Walls may be thin.
inline Mesh
nestedBodies (RandomStream& random)
{
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
}

/// A closed body in another one that has windows.
inline Mesh
bodyInShell (RandomStream& random)
{
  Mesh outer = ring (0.45);
  cutWindows (outer, upTo (5, random), random);
  samples::append (outer, ring (between (random, 0.1, 0.3)));
  return outer;
}

/// Nearly a sphere, in pieces.
inline Mesh
tornBody (RandomStream& random)
{
  constexpr Index SIDE = 50;
  Mesh mesh = makeBowl (0.97, SIDE);
  const Index width = upTo (4, random), tears = upTo (4, random), row = upTo (SIDE, random);
  takeOut (mesh, SIDE, [=] (Index x, Index y) {
    return x % (SIDE / tears) < width || (y + row) % SIDE < width;
  });
  return mesh;
}

struct Family
{
  const char* name;
  Mesh (*make) (RandomStream&);
};

constexpr std::array<Family, 4> FAMILIES{{{"winged body", wingedBody},
                                          {"nested bodies", nestedBodies},
                                          {"body in shell", bodyInShell},
                                          {"torn body", tornBody}}};

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
