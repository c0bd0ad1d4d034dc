// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The manifold part of a consensus, and clouds whose stars meet in one point several times.
#include "consensus/manifold_part.h"
#include "mesh_oracle.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <random>
#include <set>

namespace pcl::floater {
namespace {
std::vector<Triangle>
tetrahedron (Index a, Index b, Index c, Index d)
{
  return {{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}};
}

// Makes a consensus of bodies, all triangles of body i with votes[i] votes; its manifold part.
TriangleMesh
partOf (const std::vector<std::vector<Triangle>>& bodies, const std::vector<std::uint8_t>& votes,
        std::size_t points)
{
  Consensus consensus;
  for (std::size_t i = 0; i < bodies.size (); ++i)
    for (const Triangle& triangle : bodies[i]) {
      consensus.triangles.push_back (triangle);
      consensus.votes.push_back (votes[i]);
    }
  return manifoldPart (
             std::move (consensus), points, [] (Index) { return Row (); }, 1, {}, 1)
      .value ();
}

// Closed fans are walked around: the second one must not be taken for a part of the first.
TEST (ManifoldPart, KeepsTheClosedFanOfMostVotes)
{
  const std::vector<Triangle> first = tetrahedron (0, 1, 2, 3), second = tetrahedron (0, 4, 5, 6);
  const auto holds = [] (const TriangleMesh& mesh, const std::vector<Triangle>& body) {
    return std::all_of (body.begin (), body.end (), [&mesh] (const Triangle& t) {
      return std::count (mesh.triangles.begin (), mesh.triangles.end (), t) == 1;
    });
  };
  for (const bool is_first : {true, false}) {
    const TriangleMesh mesh =
        is_first ? partOf ({first, second}, {3, 2}, 7) : partOf ({first, second}, {2, 3}, 7);
    EXPECT_TRUE (samples::topologyOf (mesh.triangles).manifold);
    EXPECT_EQ (mesh.triangles.size (), 5); // the other one keeps the triangle away from the point
    EXPECT_TRUE (holds (mesh, is_first ? first : second));
  }
}

TEST (ManifoldPart, DropsTheTriangleOfFewerVotesAtADoubleEdge)
{
  const TriangleMesh mesh = partOf ({{{0, 1, 2}}, {{0, 1, 3}}}, {1, 2}, 4);
  EXPECT_EQ (mesh.triangles, (std::vector<Triangle>{{0, 1, 3}}));
}

// Crumbs of the lattice of 3 x 3 x 3 points, of which bits are places, may have several closed fans. Each ends as
// a manifold, or is refused for a reason of its own.
TEST (ManifoldPart, CrumbsOfALatticeAreManifold)
{
  std::set<std::uint32_t> crumbs;
  std::mt19937 random (1);
  for (std::size_t i = 0; i < 4000; ++i) {
    std::uint32_t crumb = i % 2 == 0 ? 1U << 13U : 0U; // with the middle
    while (std::bitset<27> (crumb).count () < 4 + i % 7)
      crumb |= 1U << random () % 27;
    crumbs.insert (crumb);
  }
  Options options;
  options.threads = 1;
  std::size_t meshes = 0;
  for (const std::uint32_t crumb : crumbs) {
    samples::Positions positions;
    for (Index i = 0; i < 27; ++i)
      if ((crumb >> i & 1U) != 0)
        positions.emplace_back (i % 3, i / 3 % 3, i / 9);
    const Result result = reconstruct (positions, options);
    ASSERT_NE (result.report.status, RunStatus::INTERNAL_ERROR)
        << result.report.message << ": crumb " << crumb;
    ASSERT_TRUE (samples::topologyOf (result.triangles).manifold) << crumb;
    meshes += result.report.status == RunStatus::SUCCESS ? 1 : 0;
  }
  EXPECT_GT (meshes, crumbs.size () / 2);
}

} // namespace
} // namespace pcl::floater
