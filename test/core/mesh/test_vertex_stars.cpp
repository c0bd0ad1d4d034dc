// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over the triangles around points, on several threads.
#include "mesh/vertex_stars.h"

#include "mesh/facing.h"
#include "mesh/flips.h"
#include "mesh/known_meshes.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
TEST (VertexStars, HaveTheTrianglesOfEachPointInTheirOrder)
{
  constexpr std::size_t POINTS = 3 * TriangleRanges::LENGTH + 5;
  RandomStream random (2);
  std::vector<Triangle> triangles (150000); // in three chunks
  std::vector<std::vector<Index>> around (POINTS);
  std::size_t improper = 0;
  for (Index t = 0; t < triangles.size (); ++t) {
    for (Index& p : triangles[t])
      p = static_cast<Index> (random.below (POINTS + 3));
    if (isProper (triangles[t], POINTS))
      for (const Index p : triangles[t])
        around[p].push_back (t);
    else
      ++improper;
  }
  EXPECT_GT (improper, 0U);
  for (const int threads : {1, 2, 5}) {
    const TriangleRanges ranges (triangles, POINTS, threads);
    ASSERT_EQ (ranges.count (), 4U);
    EXPECT_EQ (ranges.leftOut (), improper);
    for (std::size_t r = 0; r < ranges.count (); ++r) {
      const VertexStars stars (triangles, ranges, r);
      for (std::size_t p = ranges.firstPoint (r); p < ranges.lastPoint (r); ++p) {
        const VertexStar star = stars.of (p);
        ASSERT_EQ (star.size (), around[p].size ());
        for (std::size_t i = 0; i < star.size (); ++i) {
          const Triangle& t = triangles[star[i].triangle];
          EXPECT_EQ (star[i].triangle, around[p][i]);
          const std::size_t corner = t[0] == p ? 0 : t[1] == p ? 1 : 2;
          EXPECT_EQ (star[i].next, t[(corner + 1) % 3]);
          EXPECT_EQ (star[i].previous, t[(corner + 2) % 3]);
        }
      }
    }
  }
  EXPECT_EQ (TriangleRanges ({}, 0, 2).count (), 0U);
}

// A torus of three ranges of points and two chunks of triangles.
TriangleMesh
largeTorus (samples::Positions& positions)
{
  samples::Mesh torus = samples::torus (200, 170);
  positions = torus.positions;
  TriangleMesh mesh;
  mesh.triangles = torus.triangles;
  EXPECT_TRUE (mesh.connect (positions.size (), 1));
  return mesh;
}

TEST (VertexStars, NormalsAreTurnedToTheSideOfTheirAreas)
{
  samples::Positions positions;
  const TriangleMesh mesh = largeTorus (positions);
  positions.emplace_back (0, 0, 0); // no vertex
  RandomStream random (4);
  std::vector<Eigen::Vector3f> normals (positions.size ()), area (positions.size ());
  for (std::size_t p = 0; p < normals.size (); ++p) {
    normals[p] =
        Eigen::Vector3d (random.uniform () - 0.5, random.uniform () - 0.5, random.uniform () - 0.5)
            .cast<float> ();
    area[p].setZero ();
  }
  for (const Triangle& t : mesh.triangles)
    for (const Index p : t)
      area[p] += areaVectorOf (t, positions).cast<float> ();
  std::vector<Eigen::Vector3f> expected = normals;
  for (std::size_t p = 0; p < normals.size (); ++p)
    if (expected[p].dot (area[p]) < 0.0F)
      expected[p] = -expected[p];
  EXPECT_EQ (expected.back (), normals.back ());
  for (const int threads : {1, 2, 5}) {
    std::vector<Eigen::Vector3f> turned = normals;
    orientNormals (mesh, positions, turned, threads);
    EXPECT_EQ (turned, expected);
  }
}

TEST (VertexStars, SumsOfComponentsAreThoseOfOneThread)
{
  samples::Positions positions;
  const TriangleMesh mesh = largeTorus (positions);
  const MeshComponents found = findComponents (mesh, 1);
  FacingHints hints;
  hints.sensor = Eigen::Vector3d (3.0, 2.0, 5.0);
  const std::vector<Eigen::Vector3f> up (positions.size (), Eigen::Vector3f::UnitZ ());
  hints.normals = &up;
  const std::vector<FacingSums> one = sumComponents (mesh, positions, found, hints, {}, 1);
  ASSERT_EQ (one.size (), 1U);
  EXPECT_EQ (one[0].triangles, mesh.triangles.size ());
  EXPECT_TRUE (one[0].is_closed);
  EXPECT_EQ (one[0].at, 0U);
  EXPECT_NEAR (one[0].area_vector.norm (), 0.0, 1e-9);
  // Of a torus with the radii 1 and 0.4.
  EXPECT_NEAR (std::abs (one[0].volume) / 6.0, 2.0 * samples::PI * samples::PI * 0.16, 0.01);
  EXPECT_NEAR (one[0].area / 2.0, 4.0 * samples::PI * samples::PI * 0.4, 0.05);
  for (const int threads : {2, 5}) {
    const FacingSums more = sumComponents (mesh, positions, found, hints, {}, threads)[0];
    EXPECT_EQ (more.area_vector, one[0].area_vector);
    EXPECT_EQ (more.area, one[0].area);
    EXPECT_EQ (more.volume, one[0].volume);
    EXPECT_EQ (more.seen, one[0].seen);
    EXPECT_EQ (more.in_sight, one[0].in_sight);
    EXPECT_EQ (more.contradictory, one[0].contradictory);
  }
}
} // namespace
} // namespace pcl::floater
