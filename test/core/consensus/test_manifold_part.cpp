// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The manifold part of a consensus, and clouds whose stars meet in one point several times.
#include "consensus/manifold_part.h"
#include "mesh_oracle.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

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

TEST (ManifoldPart, KeepsWholeBodies)
{
  const std::vector<Triangle> body = tetrahedron (0, 1, 2, 3);
  EXPECT_EQ (partOf ({body}, {1}, 4).triangles, body);
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

TEST (ManifoldPart, LeavesTheDecisionAtAPartialPointOpen)
{
  Consensus consensus;
  consensus.triangles = {{0, 1, 2}, {0, 3, 4}};
  consensus.votes = {3, 2};
  const auto none = [] (Index) { return Row (); };
  EXPECT_FALSE (manifoldPart (consensus, 5, none, 1, {0, 0, 0, 1, 0}, 1));
  EXPECT_EQ (manifoldPart (consensus, 5, none, 1, {}, 1)->triangles.size (), 1);
}

// Crumbs of a lattice of 3 x 3 x 3 points around its middle, which may have several closed fans.
// Each ends as a manifold, or is refused for a reason of its own.
TEST (ManifoldPart, CrumbsOfALatticeAreManifold)
{
  constexpr Index MIDDLE = 13;
  std::mt19937 random (1);
  Options options;
  options.threads = 1;
  std::size_t meshes = 0;
  for (int crumb = 0; crumb < 2000; ++crumb) {
    std::set<Index> places{MIDDLE};
    while (places.size () < 6 + static_cast<std::size_t> (crumb) % 5)
      places.insert (static_cast<Index> (random () % 27));
    samples::Positions positions;
    for (const Index i : places)
      positions.emplace_back (i % 3, i / 3 % 3, i / 9);
    const Result result = reconstruct (positions, options);
    ASSERT_NE (result.report.status, RunStatus::INTERNAL_ERROR) << result.report.message;
    ASSERT_TRUE (samples::topologyOf (result.triangles).manifold);
    meshes += result.report.status == RunStatus::SUCCESS ? 1 : 0;
  }
  EXPECT_GT (meshes, 1500);
}

} // namespace
} // namespace pcl::floater
