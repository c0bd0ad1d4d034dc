// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/visibility.h"

#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

#include <map>

namespace pcl::floater {
namespace {
using samples::Positions;

Eigen::Vector3d
randomDirection (RandomStream& random)
{
  return {random.normal (), random.normal (), random.normal ()};
}

// Solves for the place in the plane of the triangle, and returns the multiple of the direction; 0:
// none.
double
hitBySolving (const Triangle& t, const Positions& positions, const Eigen::Vector3d& origin,
              const Eigen::Vector3d& direction)
{
  Eigen::Matrix3d system;
  system << positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]], -direction;
  const Eigen::Vector3d x = system.fullPivLu ().solve (origin - positions[t[0]]);
  return x[0] >= 0.0 && x[1] >= 0.0 && x[0] + x[1] <= 1.0 ? std::max (0.0, x[2]) : 0.0;
}

TEST (TriangleRays, MeetTheTrianglesThatTheyCross)
{
  const Positions positions = samples::randomPoints (300, 1);
  RandomStream random (2);
  std::vector<Triangle> triangles;
  while (triangles.size () < 500) {
    const auto a = static_cast<Index> (random.below (300)),
               b = static_cast<Index> (random.below (300)),
               c = static_cast<Index> (random.below (300));
    if (a != b && b != c && c != a)
      triangles.push_back ({a, b, c});
  }
  const TriangleRays rays (triangles, positions, 2);
  std::size_t hits = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d origin = 2.0 * randomDirection (random);
    Eigen::Vector3d direction =
        positions[random.below (300)] + 0.1 * randomDirection (random) - origin;
    if (i % 5 == 0)
      direction = Eigen::Vector3d::Unit (i % 3);
    std::map<Index, double> found;
    rays.forHits (origin, direction, [&] (Index t, double at) {
      EXPECT_TRUE (found.emplace (t, at).second) << "met twice";
      return false;
    });
    for (Index t = 0; t < triangles.size (); ++t) {
      const double at = hitBySolving (triangles[t], positions, origin, direction);
      ASSERT_EQ (found.count (t), at > 0.0 ? 1U : 0U);
      if (at > 0.0) {
        EXPECT_NEAR (found[t], at, 1e-9 * std::max (1.0, at));
      }
    }
    hits += found.size ();
  }
  EXPECT_GT (hits, 1000U);
}

TEST (TriangleRays, EndWhenTheyAreToldTo)
{
  const Positions positions{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {3, 4, 5}};
  const TriangleRays rays (triangles, positions, 1);
  const auto hits = [&rays] (double height, bool ends) {
    std::size_t count = 0;
    rays.forHits ({0.2, 0.2, height}, {0.0, 0.0, 3.0}, [&] (Index, double) {
      ++count;
      return ends;
    });
    return count;
  };
  EXPECT_EQ (hits (0.0, true), 1U);
  EXPECT_EQ (hits (0.0, false), 2U);
  EXPECT_EQ (hits (3.0, false), 0U); // both are behind the origin
}

TEST (TriangleRays, DoNotSlipBetweenTriangles)
{
  // Through the edges and corners of a grid.
  samples::Mesh sheet = samples::sheet (8);
  for (Eigen::Vector3d& p : sheet.positions)
    p.z () = p.x () * p.y ();
  const Positions& positions = sheet.positions;
  const TriangleRays rays (sheet.triangles, positions, 1);
  RandomStream random (3);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d origin (0.4 + 0.1 * random.normal (), 0.4 + 0.1 * random.normal (), 3.0);
    const Triangle& t = sheet.triangles[random.below (sheet.triangles.size ())];
    const double share = i % 4 == 0 ? 0.0 : random.uniform ();
    const Eigen::Vector3d target = (1.0 - share) * positions[t[0]] + share * positions[t[1]];
    const bool is_border = target.x () < 1e-9 || target.y () < 1e-9 || target.x () > 0.8 - 1e-9 ||
                           target.y () > 0.8 - 1e-9;
    bool is_hit = false;
    rays.forHits (origin, target - origin, [&is_hit] (Index, double) { return is_hit = true; });
    EXPECT_TRUE (is_hit || is_border);
  }
}

} // namespace
} // namespace pcl::floater
