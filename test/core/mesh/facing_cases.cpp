// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facing_cases.h"

#include "known_meshes.h"
#include "surfaces.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace pcl::floater::facing_cases {
namespace {
using samples::Mesh;
using Vector = Eigen::Vector3d;

double
between (RandomStream& random, double low, double high)
{
  return low + (high - low) * random.uniform ();
}

// A unit vector, all directions alike.
Vector
randomDirection (RandomStream& random)
{
  return Vector (random.normal (), random.normal (), random.normal ()).normalized ();
}

// Bends space, by so little that nothing crosses, and turns it.
void
bendAtRandom (Mesh& mesh, RandomStream& random)
{
  struct Wave
  {
    Vector along, shift;
    double phase;
  };
  std::array<Wave, 3> waves;
  for (Wave& wave : waves) {
    wave.along = between (random, 1.0, 4.0) * randomDirection (random);
    wave.shift = 0.25 / wave.along.norm () * randomDirection (random);
    wave.phase = between (random, 0.0, 2.0 * PI);
  }
  const Eigen::Quaterniond rotation (random.normal (), random.normal (), random.normal (),
                                     random.normal ());
  for (Vector& p : mesh.positions) {
    Vector bent = p;
    for (const Wave& wave : waves)
      bent += std::sin (wave.along.dot (p) + wave.phase) * wave.shift;
    p = rotation.normalized () * bent;
  }
}

// A torus with the radii 1 and `tube`.
Mesh
ring (double tube)
{
  Mesh mesh = samples::torus (80, 30);
  for (Vector& p : mesh.positions) {
    const Vector middle = Vector (p.x (), p.y (), 0.0).normalized ();
    p = middle + tube / 0.4 * (p - middle);
  }
  return mesh;
}

Mesh
bowl (double share_of_area, Index side)
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

// Takes out the triangles at points that are not kept, and all around points that have several fans
// left, until there are none; then the components but those of at least this many triangles, or (0)
// all but the largest.
void
keepPoints (Mesh& mesh, const std::function<bool (const Vector&)>& is_kept, std::size_t least)
{
  std::vector<std::uint8_t> is_out;
  for (const Vector& p : mesh.positions)
    is_out.push_back (is_kept (p) ? 0 : 1);
  const auto takeOut = [&mesh] (const auto& is_taken) {
    mesh.triangles.erase (std::remove_if (mesh.triangles.begin (), mesh.triangles.end (), is_taken),
                          mesh.triangles.end ());
  };
  for (bool is_pinched = true; is_pinched;) {
    is_pinched = false;
    takeOut ([&] (const Triangle& t) { return is_out[t[0]] + is_out[t[1]] + is_out[t[2]] > 0; });
    // A fan has as many beginnings, corners with no triangle before them, as it has ends: one or 0.
    std::vector<std::map<Index, int>> ends (mesh.positions.size ());
    for (const Triangle& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        ++ends[t[i]][t[(i + 1) % 3]];
        --ends[t[i]][t[(i + 2) % 3]];
      }
    for (std::size_t p = 0; p < ends.size (); ++p)
      if (std::count_if (ends[p].begin (), ends[p].end (),
                         [] (const auto& end) { return end.second > 0; }) > 1)
        is_out[p] = is_pinched = true;
  }
  const TriangleMesh whole = samples::connected (mesh);
  const MeshComponents components = findComponents (whole, 1);
  std::vector<std::size_t> sizes (components.count + 1, 0); // the last one if there is none
  for (const Index c : components.of_triangle)
    ++sizes[c];
  if (least == 0)
    least = *std::max_element (sizes.begin (), sizes.end ());
  mesh.triangles.clear ();
  for (std::size_t t = 0; t < whole.triangles.size (); ++t)
    if (sizes[components.of_triangle[t]] >= least)
      mesh.triangles.push_back (whole.triangles[t]);
}

// Cuts round windows about random points of the first wall, the same through all walls.
void
cutWindows (const std::vector<Mesh*>& walls, int windows, double radius, RandomStream& random)
{
  std::vector<Vector> middles;
  for (int i = 0; i < windows; ++i)
    middles.push_back (walls[0]->positions[random.below (walls[0]->positions.size ())]);
  for (Mesh* wall : walls)
    keepPoints (
        *wall,
        [&] (const Vector& p) {
          return std::all_of (middles.begin (), middles.end (),
                              [&] (const Vector& at) { return (p - at).norm () > radius; });
        },
        0);
}

int
upTo (int most, RandomStream& random)
{
  return 1 + static_cast<int> (random.below (static_cast<std::size_t> (most)));
}

Mesh
wingedBody (RandomStream& random)
{
  Mesh mesh = ring (between (random, 0.15, 0.5));
  const double flatness = between (random, 0.3, 1.0);
  for (Vector& p : mesh.positions)
    p.z () *= flatness;
  cutWindows ({&mesh}, upTo (10, random), between (random, 0.1, 0.3), random);
  return mesh;
}

Mesh
hollowShell (RandomStream& random)
{
  const double tube = between (random, 0.35, 0.45), thickness = between (random, 0.04, 0.1);
  Mesh outer = ring (tube), inner = ring (tube - thickness);
  samples::turnRound (inner);
  samples::append (outer, inner);
  return outer;
}

Mesh
bodyInShell (RandomStream& random)
{
  Mesh outer = ring (0.45);
  cutWindows ({&outer}, upTo (5, random), between (random, 0.15, 0.3), random);
  samples::append (outer, ring (between (random, 0.1, 0.3)));
  return outer;
}

Mesh
nestedBodies (RandomStream& random)
{
  Mesh all;
  double tube = 0.45;
  const int depth = 1 + upTo (3, random);
  for (int i = 0; i < depth; ++i) {
    Mesh mesh = ring (tube);
    if (i % 2 == 1)
      samples::turnRound (mesh);
    samples::append (all, mesh);
    tube *= between (random, 0.4, 0.7);
  }
  samples::append (all, ring (0.3), 4.0 * Vector::UnitX ());
  return all;
}

// Without bands along planes.
Mesh
tornBody (RandomStream& random)
{
  Mesh mesh = bowl (0.97, 50);
  const double width = between (random, 0.02, 0.2);
  for (int i = upTo (4, random); i > 0; --i) {
    const Vector normal = randomDirection (random);
    const double at = between (random, -0.5, 0.5);
    keepPoints (
        mesh, [&] (const Vector& p) { return std::abs (normal.dot (p) - at) > 0.5 * width; }, 10);
  }
  return mesh;
}

struct Maker
{
  const char* name;
  Mesh (*make) (RandomStream&);
};

constexpr std::array<Maker, static_cast<std::size_t> (Family::COUNT)> MAKERS{
    {{"winged body", wingedBody},
     {"hollow shell", hollowShell},
     {"nested bodies", nestedBodies},
     {"body in shell", bodyInShell},
     {"torn body", tornBody}}};
} // namespace

const char*
familyName (Family family)
{
  return MAKERS[static_cast<std::size_t> (family)].name;
}

FacingCase
makeFacingCase (Family family, std::uint64_t seed)
{
  RandomStream random (seed * MAKERS.size () + static_cast<std::uint64_t> (family) + 1);
  Mesh mesh = MAKERS[static_cast<std::size_t> (family)].make (random);
  bendAtRandom (mesh, random);
  return {mesh.positions, samples::connected (mesh)};
}

FacingCase
makeBowl (double share_of_area, int side)
{
  const Mesh mesh = bowl (share_of_area, static_cast<Index> (side));
  return {mesh.positions, samples::connected (mesh)};
}

} // namespace pcl::floater::facing_cases
