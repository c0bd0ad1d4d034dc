// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/surface/floater/vertex_normals.h>

#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace pcl::floater {
namespace {
using samples::Mesh;
using samples::Positions;
using samples::Triangles;

constexpr float FLOAT_STEP = std::numeric_limits<float>::epsilon ();

// The faces of a cube around the origin, each cut along one of its diagonals.
// \param diagonals bit f: which one, of face f
Mesh
cube (unsigned diagonals)
{
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.positions.emplace_back ((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                                 (corner & 4) != 0 ? 1 : -1);
  const std::array<std::array<Index, 4>, 6> faces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (std::size_t f = 0; f < faces.size (); ++f) {
    const auto& [a, b, c, d] = faces[f];
    if ((diagonals >> f & 1U) != 0) {
      mesh.triangles.push_back ({a, b, c});
      mesh.triangles.push_back ({a, c, d});
    }
    else {
      mesh.triangles.push_back ({a, b, d});
      mesh.triangles.push_back ({b, c, d});
    }
  }
  return mesh;
}

void
expectNear (const Eigen::Vector3f& normal, const Eigen::Vector3d& expected, float tolerance)
{
  EXPECT_LE ((normal - expected.normalized ().cast<float> ()).norm (), tolerance)
      << normal.transpose () << " is not " << expected.transpose ();
}

// Weights by area, or none, would tell how the faces are cut.
TEST (VertexNormals, OfACubeAreItsDiagonalsHoweverItsFacesAreCutAndAtAnyScale)
{
  for (unsigned diagonals = 0; diagonals < 64; ++diagonals) {
    const Mesh mesh = cube (diagonals);
    for (const double scale : {1e-300, 1e-200, 1.0, 1e200, 1e300}) {
      Positions scaled = mesh.positions;
      for (Eigen::Vector3d& p : scaled)
        p *= scale;
      const std::vector<Eigen::Vector3f> normals = vertexNormals (scaled, mesh.triangles, 1);
      for (std::size_t p = 0; p < 8; ++p)
        expectNear (normals[p], mesh.positions[p], FLOAT_STEP);
    }
  }
}

TEST (VertexNormals, PointsThatNoTriangleTellsOfHaveNone)
{
  const double nan = std::nan ("");
  const Positions positions{{0, 0, 0}, {1, 0, 0},     {0, 1, 0}, {5, 5, 5}, {1, 0, 0},
                            {2, 0, 0}, {nan, nan, 0}, {1, 1, 0}, {9, 0, 0}, {9, 9, 0}};
  const Triangles triangles{{0, 1, 2}, // one that counts
                            {1, 4, 2}, // two equal corners
                            {0, 1, 5}, // on one line
                            {1, 6, 2}, // not finite
                            {7, 8, 9}, // twice, from both sides
                            {7, 9, 8}, {3, 3, 3}};
  const std::vector<Eigen::Vector3f> normals = vertexNormals (positions, triangles, 1);
  for (const std::size_t p : {0, 1, 2})
    EXPECT_EQ (normals[p], Eigen::Vector3f (0, 0, 1)) << p;
  for (const std::size_t p : {3, 4, 5, 6, 7, 8, 9})
    EXPECT_EQ (normals[p], Eigen::Vector3f (0, 0, 0)) << p;
  EXPECT_TRUE (vertexNormals ({}, {}).empty ());
  EXPECT_THROW (vertexNormals (positions, {{0, 1, 10}}), std::out_of_range);
}

} // namespace
} // namespace pcl::floater
