// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/ridges.h"

#include "mesh/flaw_repair.h"
#include "mesh/flips.h"
#include "mesh/known_meshes.h"
#include "points/neighbors.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
constexpr Index LENGTH = 6;

// A polygon (y, z), anti-clockwise, drawn along x; open at both ends. It faces outwards.
samples::Mesh
tube (const std::vector<Eigen::Vector2d>& section)
{
  samples::Mesh mesh;
  const auto corners = static_cast<Index> (section.size ());
  for (Index x = 0; x <= LENGTH; ++x)
    for (const Eigen::Vector2d& p : section)
      mesh.positions.emplace_back (x, p.x (), p.y ());
  for (Index x = 0; x < LENGTH; ++x)
    for (Index i = 0; i < corners; ++i) {
      const Index a = x * corners + i, b = x * corners + (i + 1) % corners;
      mesh.triangles.push_back ({a, b, a + corners});
      mesh.triangles.push_back ({b, b + corners, a + corners});
    }
  return mesh;
}

// An arrow head: three sharp ridges, and the notch at point 2.
samples::Mesh
arrow ()
{
  return tube ({{4.0, 0.0}, {-1.0, 1.0}, {3.0, 0.0}, {-1.0, -1.0}});
}

// Ridges at points 0 and 4.
samples::Mesh
blade ()
{
  return tube ({{2.0, 0.0},
                {1.0, 0.15},
                {0.0, 0.3},
                {-1.0, 0.15},
                {-2.0, 0.0},
                {-1.0, -0.15},
                {0.0, -0.3},
                {1.0, -0.15}});
}

Ridges
ridgesOf (const samples::Mesh& mesh, const CrossingPairs& crossing = {}, std::uint8_t is_remade = 1)
{
  return findRidges (samples::connected (mesh), mesh.positions, crossing,
                     std::vector<std::uint8_t> (mesh.positions.size (), is_remade), 1);
}

TEST (Ridges, AreSharpEdgesThatStickOut)
{
  samples::Mesh mesh = arrow ();
  std::vector<std::array<Index, 2>> expected;
  for (Index x = 0; x < LENGTH; ++x)
    for (const Index corner : {0U, 1U, 3U})
      expected.push_back ({4 * x + corner, 4 * x + 4 + corner});
  EXPECT_EQ (ridgesOf (mesh).ends, expected);
  for (Triangle& t : mesh.triangles)
    std::swap (t[1], t[2]);
  EXPECT_EQ (ridgesOf (mesh).ends, expected) << "inside out";
  EXPECT_TRUE (ridgesOf (mesh).has (4, 0) && ridgesOf (mesh).has (0, 4));
  EXPECT_FALSE (ridgesOf (mesh).has (2, 6)) << "the notch";
}

TEST (Ridges, AreOnlyWhereTheMeshWasMadeInSpaceAndNothingCrosses)
{
  const samples::Mesh mesh = arrow ();
  EXPECT_TRUE (ridgesOf (mesh, {}, 0).ends.empty ());
  EXPECT_TRUE (findRidges (samples::connected (mesh), mesh.positions, {}, {}, 1).ends.empty ());
  CrossingPairs crossing;
  crossing.push_back ({0, 8}); // at points 0 and 4, and at 4 and 8
  const Ridges without = ridgesOf (mesh, crossing);
  EXPECT_FALSE (without.has (0, 4) || without.has (4, 8));
  EXPECT_TRUE (without.has (8, 12));
}

// The normals are those of a tangent plane of both sides of a blade: they tell nothing.
TEST (Ridges, AreKeptByTheRepair)
{
  const samples::Mesh sharp = blade ();
  const Ridges ridges = ridgesOf (sharp);
  EXPECT_EQ (ridges.ends.size (), 2 * LENGTH);
  const CsrLists neighbors =
      findNearestNeighbors (sharp.positions, Rows::all (sharp.positions.size ()), 20, 1);
  const std::vector<Eigen::Vector3f> normals (sharp.positions.size (), Eigen::Vector3f::UnitZ ());
  const TriangleCost cost (sharp.positions, normals);
  for (const bool are_known : {true, false}) {
    TriangleMesh mesh = samples::connected (sharp);
    CrossingPairs crossing;
    const Repairs done =
        repairFlaws (mesh, crossing, neighbors, cost, sharp.positions, Repair::BEFORE_REMAKING,
                     are_known ? ridges : Ridges{}, {}, 1);
    EXPECT_TRUE (done.hasChanged ());
    EXPECT_EQ (std::all_of (ridges.ends.begin (), ridges.ends.end (),
                            [&] (const auto& ends) { return mesh.hasEdge (ends[0], ends[1]); }),
               are_known);
  }
}

TEST (Ridges, PointsThereGetTheNormalsOfTheMesh)
{
  const samples::Mesh sharp = blade ();
  const std::size_t points = sharp.positions.size ();
  std::vector<std::uint8_t> is_remade (points, 1);
  is_remade[3] = 0;
  std::vector<Eigen::Vector3f> normals (points, -Eigen::Vector3f::UnitZ ());
  orientNormals (samples::connected (sharp), sharp.positions, normals, 1, is_remade);
  for (Index p = 0; p < points; ++p)
    EXPECT_GT (normals[p].dot (Eigen::Vector3f (0.0F, static_cast<float> (sharp.positions[p].y ()),
                                                static_cast<float> (sharp.positions[p].z ()))
                                   .normalized ()),
               0.0F)
        << p;
  EXPECT_EQ (normals[3], Eigen::Vector3f::UnitZ ()) << "not made in space: only turned";
}

} // namespace
} // namespace pcl::floater
