// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Places in space: tetrahedra, the two sides of a surface, and zones of a mesh made anew.
#include "mesh/remaking.h"

#include "core/tetrahedra.h"
#include "mesh/known_meshes.h"
#include "mesh/two_sides.h"
#include "mesh_oracle.h"
#include "points/neighbors.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Positions;

TEST (Tetrahedra, HaveNoPointInTheirBallsAndKnowEachOther)
{
  const Positions points = samples::randomPoints (60, 1);
  const Tetrahedra all = delaunayInSpace (points);
  std::size_t finite = 0;
  for (Index t = 0; t < all.size (); ++t) {
    const auto& c = all.corners[t];
    for (unsigned k = 0; k < 4; ++k) {
      const auto& back = all.neighbors[all.neighbors[t][k]];
      EXPECT_NE (std::find (back.begin (), back.end (), t), back.end ());
      if (c[k] != NONE) {
        const Row around = all.around.row (c[k]);
        EXPECT_TRUE (std::binary_search (around.begin (), around.end (), t));
      }
    }
    if (all.isInfinite (t))
      continue;
    ++finite;
    // The centre has the same distance from all corners.
    Eigen::Matrix3d edges;
    Eigen::Vector3d half_squares;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d edge = points[c[static_cast<unsigned> (k) + 1]] - points[c[0]];
      edges.row (k) = edge;
      half_squares[k] = 0.5 * edge.squaredNorm ();
    }
    for (unsigned k = 0; k < 4; ++k) {
      const Triangle facet = all.facet (t, k);
      const Eigen::Vector3d outwards =
          areaVector (points[facet[0]], points[facet[1]], points[facet[2]]);
      EXPECT_LT (outwards.dot (points[c[k]] - points[facet[0]]), 0.0);
    }
    const Eigen::Vector3d to_centre = edges.inverse () * half_squares;
    for (const Eigen::Vector3d& p : points)
      EXPECT_GT ((p - points[c[0]] - to_centre).norm (), to_centre.norm () - 1e-6);
  }
  EXPECT_GT (finite, 100U);
  EXPECT_EQ (delaunayInSpace ({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).size (), 0U);
  EXPECT_EQ (delaunayInSpace ({}).size (), 0U);
  // Each point of a line and each of another one would share tetrahedra.
  Positions lines;
  for (int i = 0; i < 1000; ++i)
    lines.push_back (i % 2 == 0 ? Eigen::Vector3d (i, 0, 0) : Eigen::Vector3d (0, i, 1000));
  EXPECT_EQ (delaunayInSpace (lines).size (), 0U);
}

// Without a frame, the outside is the front.
TEST (TwoSides, OfABodyAreItsInsideAndItsOutside)
{
  Place place;
  place.positions = samples::evenSphere (300);
  place.is_free.assign (300, 1);
  place.is_rim.assign (300, 0);
  place.is_boundary.assign (300, 0);
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

TEST (TwoSides, NeedPointsInSpace)
{
  Place place;
  place.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  place.is_free = place.is_rim = place.is_boundary = {0, 0, 0, 0};
  EXPECT_FALSE (remakePlace (place, 1).is_right);
}

CsrLists
neighborsOf (const Positions& positions)
{
  return findNearestNeighbors (positions, Rows::all (positions.size ()), 20, 1, 1);
}

// The meshes of two spheres beside each other, as one.
struct Spheres
{
  Positions positions = samples::evenSphere (400);
  CsrLists neighbors;
  std::vector<float> spacing;
  TriangleMesh mesh;

  explicit Spheres (double gap)
  {
    const Positions second = samples::evenSphere (400, {2.0 + gap, 0.0, 0.0});
    Place place;
    place.is_free.assign (400, 1);
    place.is_rim = place.is_boundary = std::vector<std::uint8_t> (400, 0);
    samples::Mesh both;
    for (const Positions& one : {positions, second}) {
      place.positions = one;
      samples::append (both, {one, remakePlace (place, 1).triangles});
    }
    positions = both.positions;
    mesh = samples::connected (both);
    neighbors = neighborsOf (positions);
    spacing.assign (positions.size (), 0.17F);
  }

  Remaking remake (int threads = 1)
  {
    CrossingPairs crossing = findSelfIntersections (mesh.triangles, positions, 1);
    const Remaking done = remakeZones (mesh, positions, neighbors, spacing, crossing, {}, threads);
    EXPECT_EQ (crossing, findSelfIntersections (mesh.triangles, positions, 1));
    return done;
  }
};

TEST (Remaking, LeavesACleanMeshAlone)
{
  Spheres spheres (0.1);
  const std::vector<Triangle> before = spheres.mesh.triangles;
  const Remaking done = spheres.remake ();
  EXPECT_EQ (done.zones + done.failed, 0U);
  EXPECT_EQ (spheres.mesh.triangles, before);
}

// Two points that change places make the triangles around them cross.
TEST (Remaking, CuresTrianglesThatCross)
{
  for (const double gap : {0.1, 3.0}) {
    Spheres spheres (gap);
    samples::exchange (spheres.mesh, 100, 121);
    ASSERT_FALSE (findSelfIntersections (spheres.mesh.triangles, spheres.positions, 1).empty ());
    Spheres by_two = spheres;
    EXPECT_GT (spheres.remake ().zones, 0U);
    EXPECT_TRUE (findSelfIntersections (spheres.mesh.triangles, spheres.positions, 1).empty ());
    const samples::Topology topology = samples::topologyOf (spheres.mesh.triangles);
    EXPECT_TRUE (topology.manifold);
    EXPECT_EQ (topology.components, 2U);
    EXPECT_EQ (topology.euler, 4);
    by_two.remake (2);
    EXPECT_EQ (by_two.mesh.triangles, spheres.mesh.triangles);
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
  EXPECT_GT (spheres.remake ().zones, 0U);
  const samples::Topology topology = samples::topologyOf (spheres.mesh.triangles);
  EXPECT_EQ (topology.euler, 4);
  EXPECT_EQ (topology.loops.size (), 0U);
  EXPECT_NE (spheres.mesh.triangle_of[7], NONE);
}

// A window has one sheet around it and stays; a loop of five points is none.
TEST (Remaking, KeepsOpenings)
{
  const auto remake = [] (Index around) {
    const samples::Mesh ring = samples::annulus (around);
    TriangleMesh mesh = samples::connected (ring);
    CrossingPairs crossing;
    return remakeZones (mesh, ring.positions, neighborsOf (ring.positions),
                        std::vector<float> (ring.positions.size (), 1.0F), crossing, {}, 1);
  };
  EXPECT_EQ (remake (12).zones + remake (12).failed, 0U);
  EXPECT_GT (remake (5).zones + remake (5).failed, 0U);
}

} // namespace
} // namespace pcl::floater
