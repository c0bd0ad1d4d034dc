// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The common orientation of normals, the manifold part of a consensus, and clouds whose stars meet in one point several
// times.
#include "consensus/consensus.h"

#include "consensus/consensus_method.h"
#include "mesh_oracle.h"
#include "samples.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

#include <bitset>
#include <cstdlib>
#include <random>

namespace pcl::floater {
namespace {
using namespace samples;

// A candidate by the normals of its corners: bit i of `down` is set if normal i points down.
Candidate
candidate (const Triangle& corners, std::uint8_t down, std::uint8_t votes = 3)
{
  return {corners, votes, down, false, 1.0F, 1.0F};
}

TEST (Orientation, TheMajorityOfVotesDecides)
{
  // Two sets of points, 0 to 2 and 3 to 5, and candidates between them.
  for (const bool is_more_opposite : {false, true}) {
    Orientation orientation (6);
    ASSERT_TRUE (orientation.join ({0, 1, 2}, 0));
    ASSERT_TRUE (orientation.join ({3, 4, 5}, 0));
    const std::vector<Candidate> candidates{
        candidate ({0, 1, 3}, 0), candidate ({1, 2, 4}, 4, 2),
        candidate ({2, 0, 5}, 4, static_cast<std::uint8_t> (is_more_opposite ? 3 : 0))};
    const std::vector<Index> voters{0, 1, 2};
    orientation.vote (candidates, {voters.data (), voters.data () + voters.size ()}, 1);
    std::vector<Eigen::Vector3f> normals (6, Eigen::Vector3f::UnitZ ());
    orientation.turn (normals, 1);
    EXPECT_EQ (normals[0].z () != normals[3].z (), is_more_opposite);
  }
}

std::vector<Triangle>
tetrahedron (Index a, Index b, Index c, Index d)
{
  return {{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}};
}

// Makes a consensus of bodies, all triangles of body i with votes[i] votes; its manifold part.
TriangleMesh
partOf (const std::vector<std::vector<Triangle>>& bodies, const std::vector<std::uint8_t>& votes,
        const CsrLists& neighbors, std::size_t smallest = 1)
{
  Consensus consensus;
  for (std::size_t i = 0; i < bodies.size (); ++i)
    for (const Triangle& triangle : bodies[i]) {
      consensus.triangles.push_back (triangle);
      consensus.votes.push_back (votes[i]);
    }
  return manifoldPart (std::move (consensus), Positions (neighbors.rows ()),
                       Normals (neighbors.rows ()), neighbors, smallest, 1);
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
  const CsrLists no_neighbors{std::vector<Index> (8, 0), {}};
  for (const std::vector<std::uint8_t>& votes : {std::vector<std::uint8_t>{3, 2}, {2, 3}}) {
    const TriangleMesh mesh = partOf ({first, second}, votes, no_neighbors);
    EXPECT_TRUE (topologyOf (mesh.triangles).manifold);
    EXPECT_EQ (mesh.triangles.size (), 5); // the other one keeps the triangle away from the point
    EXPECT_TRUE (holds (mesh, votes[0] > votes[1] ? first : second));
  }
}

TEST (ManifoldPart, DropsTheTriangleOfFewerVotesAtADoubleEdge)
{
  const TriangleMesh mesh =
      partOf ({{{0, 1, 2}}, {{0, 1, 3}}}, {1, 2}, {std::vector<Index> (5, 0), {}});
  EXPECT_EQ (mesh.triangles, (std::vector<Triangle>{{0, 1, 3}}));
}

// A small component beside a larger one is an island, unless it is closed: then it is a body.
TEST (ManifoldPart, HasNoSmallIslandsButBodies)
{
  const std::vector<Triangle> island{{4, 5, 6}},
      body = tetrahedron (4, 5, 6, 7),
      sheet{{0, 1, 2}, {0, 2, 3}, {0, 3, 8}, {3, 9, 8}, {9, 10, 8}};
  CsrLists neighbors{std::vector<Index> (5, 0), {0}}; // only that point 4 is beside point 0
  neighbors.offsets.resize (12, 1);
  EXPECT_EQ (partOf ({body, sheet}, {3, 3}, neighbors, 9).triangles.size (), 4 + 5);
  EXPECT_EQ (partOf ({island, sheet}, {3, 3}, neighbors, 9).triangles.size (), 5);
}

// Pieces of leaves, as an airborne scan has them, are of the surface around. Clean ribbons above a plate
// are not.
TEST (ManifoldPart, DissolvesRaggedPiecesOfLeavesButKeepsRibbons)
{
  const auto componentsOf = [] (unsigned seed, bool has_leaves) {
    std::mt19937 random (seed);
    std::normal_distribution<double> offset (0.0, 0.2);
    std::uniform_real_distribution<double> height (0.0, 6.0);
    Positions points;
    for (int x = 0; x < 60; ++x)
      for (int y = 0; y < 30; ++y) {
        const auto add = [&] (double z) {
          points.emplace_back (x + offset (random), y + offset (random), z + 0.1 * offset (random));
        };
        add (has_leaves && random () % 2 == 0 ? height (random) : 0.0);
        if (!has_leaves && y % 10 < 3 && x > 5 && x < 55)
          add (2.5);
      }
    return reconstruct (points, {}).report.check.components;
  };
  std::size_t pieces = 0;
  for (unsigned seed = 1; seed <= 5; ++seed)
    pieces += componentsOf (seed, true) - 1;
  EXPECT_LE (pieces, 2);
  EXPECT_EQ (componentsOf (1, false), 4);
}

// Crumbs may have several closed fans. Each ends as a manifold, or is refused for a reason of its
// own: all of up to 5 points that are distinct, and samples of 6 to 10 around the middle.
// PCL_FLOATER_CRUMBS: all of up to so many points.
TEST (ManifoldPart, CrumbsOfALatticeAreManifold)
{
  constexpr std::uint32_t MIDDLE = 1U << 13U, END = 1U << 27U;
  const char* const more = std::getenv ("PCL_FLOATER_CRUMBS");
  const std::size_t most = more != nullptr ? std::stoul (more) : 5;
  std::map<std::vector<std::vector<double>>, Positions> crumbs;
  const auto add = [&crumbs] (std::uint32_t bits) {
    Positions crumb; // the points of the lattice of 3 x 3 x 3 whose bits are set
    for (Index i = 0; i < 27; ++i)
      if ((bits >> i & 1U) != 0)
        crumb.emplace_back (i % 3, i / 3 % 3, i / 9);
    // The distances from each point to all, which are the same of crumbs that can be moved onto each other.
    std::vector<std::vector<double>> distances;
    for (const Eigen::Vector3d& p : crumb) {
      std::vector<double>& squares = distances.emplace_back ();
      for (const Eigen::Vector3d& q : crumb)
        squares.push_back ((p - q).squaredNorm ());
      std::sort (squares.begin (), squares.end ());
    }
    std::sort (distances.begin (), distances.end ());
    crumbs.emplace (distances, crumb);
  };
  for (std::size_t size = 3; size <= most; ++size)
    for (std::uint32_t bits = (1U << size) - 1; bits < END;) {
      add (bits);
      const std::uint32_t lowest = bits & (~bits + 1U), next = bits + lowest;
      bits = next | ((bits ^ next) / lowest >> 2U); // as many bits, the next larger
    }
  EXPECT_GT (crumbs.size (), 1000U);
  std::mt19937 random (1);
  for (std::size_t i = 0; i < 2000; ++i) {
    std::uint32_t bits = MIDDLE;
    while (std::bitset<27> (bits).count () < 6 + i % 5)
      bits |= 1U << random () % 27;
    add (bits);
  }
  Options options;
  options.threads = 1;
  std::size_t meshes = 0;
  for (const auto& [distances, crumb] : crumbs) {
    const Result result = reconstruct (crumb, options);
    SCOPED_TRACE (testing::PrintToString (crumb));
    ASSERT_NE (result.report.status, RunStatus::INTERNAL_ERROR) << result.report.message;
    ASSERT_TRUE (topologyOf (result.triangles).manifold);
    meshes += result.report.status == RunStatus::SUCCESS ? 1 : 0;
  }
  EXPECT_GT (meshes, crumbs.size () / 2);
}

} // namespace
} // namespace pcl::floater
