// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Places in space: the two sides of a surface, and zones of a mesh made anew.
#include "mesh/remaking.h"

#include "mesh/known_meshes.h"
#include "mesh/two_sides.h"
#include "mesh_oracle.h"
#include "points/neighbors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pcl::floater {
namespace {
using samples::Positions;

// A place with these points, all of them free.
Place
placeOf (const Positions& positions)
{
  Place place;
  place.positions = positions;
  place.is_free.assign (positions.size (), 1);
  place.is_rim = place.is_boundary = std::vector<std::uint8_t> (positions.size (), 0);
  return place;
}

// Without a frame, the outside is the front.
TEST (TwoSides, OfABodyAreItsInsideAndItsOutside)
{
  const Place place = placeOf (samples::evenSphere (300));
  const RemadePlace made = remakePlace (place, 1);
  EXPECT_TRUE (made.is_right);
  const samples::Topology topology = samples::topologyOf (made.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.euler, 2);
  EXPECT_EQ (topology.loops.size (), 0U);
  double volume = 0.0;
  for (const Triangle& t : made.triangles)
    volume += place.positions[t[0]].dot (place.positions[t[1]].cross (place.positions[t[2]])) / 6.0;
  EXPECT_NEAR (volume, 4.0 / 3.0 * PI, 0.15);
}

// Noise of half a spacing leaves pieces of a side around some points of every second sphere. Single
// tetrahedra mend ten of 40 spheres. Points that cannot be mended are left out.
TEST (TwoSides, PiecesAroundAPointAreMendedOrThePointIsLeftOut)
{
  std::size_t mended = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random (seed);
    Positions positions = samples::evenSphere (300);
    for (Eigen::Vector3d& p : positions)
      p *= 1.0 + 0.2 * (static_cast<double> (random ()) / 4294967296.0 - 0.5);
    const RemadePlace made = remakePlace (placeOf (positions), 1);
    const samples::Topology topology = samples::topologyOf (made.triangles);
    EXPECT_TRUE (made.is_right);
    EXPECT_TRUE (topology.manifold);
    EXPECT_EQ (topology.loops.size (), 0U);
    EXPECT_GE (topology.vertices, 294U);
    mended += made.flawed > 0 && topology.vertices == 300 ? 1 : 0;
  }
  EXPECT_GE (mended, 9U);
}

CsrLists
neighborsOf (const Positions& positions)
{
  return findNearestNeighbors (positions, Rows::all (positions.size ()), 20, 1);
}

// The meshes of two spheres beside each other, as one.
struct Spheres
{
  Positions positions;
  CsrLists neighbors;
  std::vector<float> spacing;
  TriangleMesh mesh;

  explicit Spheres (double gap, std::size_t points = 400, bool along_curve = false)
  {
    Positions first = samples::evenSphere (points);
    if (along_curve)
      std::sort (first.begin (), first.end (),
                 [] (const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
                   return hilbertCode (p / 4.0) < hilbertCode (q / 4.0);
                 });
    Positions second = first;
    for (Eigen::Vector3d& p : second)
      p.x () += 2.0 + gap;
    samples::Mesh both;
    for (const Positions& one : {first, second})
      samples::append (both, {one, remakePlace (placeOf (one), 1).triangles});
    positions = both.positions;
    mesh = samples::connected (both);
    neighbors = neighborsOf (positions);
    spacing.assign (positions.size (), 3.4F / std::sqrt (static_cast<float> (points)));
  }

  RemadeZones remake ()
  {
    CrossingPairs crossing = findSelfIntersections (mesh.triangles, positions, 1);
    RemadeZones remade;
    remakeZones (mesh, positions, neighbors, spacing, crossing, 3, remade, {}, 2);
    EXPECT_EQ (crossing, findSelfIntersections (mesh.triangles, positions, 1));
    return remade;
  }
};

TEST (Remaking, LeavesACleanMeshAlone)
{
  Spheres spheres (0.1);
  const std::vector<Triangle> before = spheres.mesh.triangles;
  EXPECT_EQ (spheres.remake ().points (), 0U);
  EXPECT_EQ (spheres.mesh.triangles, before);
}

// Two points that change places make the triangles around them cross.
TEST (Remaking, CuresTrianglesThatCross)
{
  for (const double gap : {0.1, 3.0}) {
    Spheres spheres (gap);
    samples::exchange (spheres.mesh, 100, 121);
    ASSERT_FALSE (findSelfIntersections (spheres.mesh.triangles, spheres.positions, 1).empty ());
    EXPECT_GT (spheres.remake ().points (), 0U);
    EXPECT_TRUE (findSelfIntersections (spheres.mesh.triangles, spheres.positions, 1).empty ());
    const samples::Topology topology = samples::topologyOf (spheres.mesh.triangles);
    EXPECT_TRUE (topology.manifold);
    EXPECT_EQ (topology.components, 2U);
    EXPECT_EQ (topology.euler, 4);
  }
}

// A zone of all points is tried in some places first.
TEST (Remaking, MakesALargeZoneAnewUnlessItIsNoise)
{
  for (const bool is_noisy : {false, true}) {
    Spheres spheres (0.1, 3000, true);
    for (Index p = 0; p < 5900; p += 25)
      samples::exchange (spheres.mesh, p, p + 21);
    std::mt19937 random (5);
    std::normal_distribution<double> noise (0.0, 0.05);
    for (Eigen::Vector3d& position : spheres.positions)
      for (int k = 0; is_noisy && k < 3; ++k)
        position[k] += noise (random);
    const std::vector<Triangle> before = spheres.mesh.triangles;
    const RemadeZones remade = spheres.remake ();
    EXPECT_EQ (remade.is_noise, is_noisy);
    EXPECT_EQ (remade.points () > 5900, !is_noisy);
    EXPECT_EQ (spheres.mesh.triangles == before, is_noisy);
    EXPECT_EQ (findSelfIntersections (spheres.mesh.triangles, spheres.positions, 1).empty (),
               !is_noisy);
  }
}

TEST (Remaking, TriesNoZoneOfOneSizeTwice)
{
  for (const bool has_failed : {false, true}) {
    Spheres spheres (0.1);
    samples::exchange (spheres.mesh, 100, 121);
    CrossingPairs crossing = findSelfIntersections (spheres.mesh.triangles, spheres.positions, 1);
    const DisturbedZones zones =
        findDisturbedZones (spheres.mesh, spheres.positions, spheres.neighbors, spheres.spacing,
                            crossing, 1, false, {}, 1);
    ASSERT_EQ (zones.points.rows (), 1U);
    RemadeZones remade;
    remade.failed.assign (spheres.positions.size (), has_failed ? zones.points.row (0).size () : 0);
    remakeZones (spheres.mesh, spheres.positions, spheres.neighbors, spheres.spacing, crossing, 1,
                 remade, {}, 1);
    EXPECT_EQ (remade.points (), has_failed ? 0 : zones.points.row (0).size ());
    EXPECT_EQ (crossing.empty (), !has_failed);
  }
}

// A point without a triangle, and a hole that its loss left.
TEST (Remaking, BringsPointsBack)
{
  Spheres spheres (0.1);
  auto& triangles = spheres.mesh.triangles;
  const auto hasPoint = [] (const Triangle& t) { return t[0] == 7 || t[1] == 7 || t[2] == 7; };
  triangles.erase (std::remove_if (triangles.begin (), triangles.end (), hasPoint),
                   triangles.end ());
  ASSERT_TRUE (spheres.mesh.connect (spheres.positions.size (), 1));
  EXPECT_GT (spheres.remake ().points (), 0U);
  const samples::Topology topology = samples::topologyOf (spheres.mesh.triangles);
  EXPECT_EQ (topology.euler, 4);
  EXPECT_EQ (topology.loops.size (), 0U);
  EXPECT_NE (spheres.mesh.triangle_of[7], NONE);
}

// Four points under the surface are a body of their own, which is no part of it.
TEST (Remaking, LeavesOutIslands)
{
  Spheres spheres (3.0);
  samples::exchange (spheres.mesh, 100, 121);
  const Eigen::Vector3d below = 0.75 * spheres.positions[100];
  spheres.positions.push_back (below);
  for (int k = 0; k < 3; ++k)
    spheres.positions.push_back (below + 0.05 * Eigen::Vector3d::Unit (k));
  ASSERT_TRUE (spheres.mesh.connect (spheres.positions.size (), 1));
  spheres.neighbors = neighborsOf (spheres.positions);
  spheres.spacing.resize (spheres.positions.size (), spheres.spacing[0]);
  EXPECT_GT (spheres.remake ().points (), 0U);
  EXPECT_TRUE (findSelfIntersections (spheres.mesh.triangles, spheres.positions, 1).empty ());
  const samples::Topology topology = samples::topologyOf (spheres.mesh.triangles);
  EXPECT_EQ (topology.vertices, 800U);
  EXPECT_EQ (topology.components, 2U);
  EXPECT_EQ (topology.euler, 4);
}

// A window has one sheet around it and stays; a loop of five points is none.
TEST (Remaking, KeepsOpenings)
{
  const auto zones = [] (Index around) {
    const samples::Mesh ring = samples::annulus (around);
    return findDisturbedZones (
               samples::connected (ring), ring.positions, neighborsOf (ring.positions),
               std::vector<float> (ring.positions.size (), 1.0F), {}, 3, false, {}, 1)
        .points.rows ();
  };
  EXPECT_EQ (zones (12), 0U);
  EXPECT_GT (zones (5), 0U);
}

} // namespace
} // namespace pcl::floater
