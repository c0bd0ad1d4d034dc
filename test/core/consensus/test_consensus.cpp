// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The common orientation of normals, the boundary loop of a disc as a loop of the triangles that stars agree on,
// the manifold part of a consensus, and clouds whose stars meet in one point several times.
#include "consensus/consensus.h"

#include "consensus/consensus_method.h"
#include "consensus/orientation.h"
#include "mesh_oracle.h"
#include "samples.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cstdlib>
#include <random>
#include <set>
#include <string>

namespace pcl::floater {
namespace {
using namespace samples;

// A candidate by the normals of its corners: bit i of `down` is set if normal i points down.
Candidate
candidate (const Triangle& corners, std::uint8_t down, std::uint8_t votes = 3)
{
  return {corners, votes, down, false, 1.0F, 1.0F};
}

std::vector<std::uint8_t>
sidesOf (Orientation& orientation, std::size_t points)
{
  std::vector<Eigen::Vector3f> normals (points, Eigen::Vector3f::UnitZ ());
  orientation.turn (normals, 1);
  std::vector<std::uint8_t> sides;
  for (const Eigen::Vector3f& normal : normals)
    sides.push_back (normal.z () > 0.0F ? 0 : 1);
  return sides;
}

void
vote (Orientation& orientation, const std::vector<Candidate>& candidates)
{
  std::vector<const Candidate*> pointers;
  for (const Candidate& each : candidates)
    pointers.push_back (&each);
  orientation.vote (pointers.data (), pointers.data () + pointers.size (), 1);
}

TEST (Orientation, TheMajorityOfVotesDecides)
{
  // Two sets of points, 0 to 2 and 3 to 5, and candidates between them.
  for (const bool is_more_opposite : {false, true}) {
    Orientation orientation (6);
    ASSERT_TRUE (orientation.join ({0, 1, 2}, 0));
    ASSERT_TRUE (orientation.join ({3, 4, 5}, 0));
    vote (orientation,
          {candidate ({0, 1, 3}, 0), candidate ({1, 2, 4}, 4, 2),
           candidate ({2, 0, 5}, 4, static_cast<std::uint8_t> (is_more_opposite ? 3 : 0))});
    const std::vector<std::uint8_t> sides = sidesOf (orientation, 6);
    EXPECT_EQ (sides[0] != sides[3], is_more_opposite);
  }
}

Boundary
find (const Neighborhoods& made)
{
  Boundary boundary = consensusLoop (made.points.positions, made.geometry, 1);
  checkBoundary (made.points, made.geometry.spacing, false, boundary);
  return boundary;
}

// A hole in the sheet is no border, however it is sampled.
TEST (ConsensusLoop, IsTheBorderAndNotAHole)
{
  const Outline rim = circle (1.0, 0.06), hole = circle (0.4, 0.06);
  for (const std::vector<Outline>& outlines :
       {std::vector<Outline>{rim}, std::vector<Outline>{rim, hole}}) {
    const Sheet sheet = fillOutlines (outlines, 0.06, 0.35, 6);
    const Neighborhoods made = makeNeighborhoods (sheet.positions);
    const std::vector<Eigen::Vector3f> normals = made.geometry.stars.normals;
    const Boundary boundary = find (made);
    EXPECT_FALSE (boundary.problem);
    std::vector<Index> loop;
    for (const Index p : boundary.loop)
      loop.push_back (made.points.cloud_index[p]);
    EXPECT_EQ (canonicalCycle (loop), indices (sheet.border));
    EXPECT_GE (boundary.candidates, sheet.border + (outlines.size () - 1) * hole.size ());
    EXPECT_LT (boundary.largest_step, 2.0);
    EXPECT_EQ (made.geometry.stars.normals, normals);
  }
}

TEST (ConsensusLoop, OfAClosedSurfaceIsEmpty)
{
  const Boundary boundary = find (makeNeighborhoods (evenSphere (1500)));
  EXPECT_EQ (boundary.problem.status, RunStatus::NO_BOUNDARY);
  EXPECT_FALSE (boundary.problem.message.empty ());
  EXPECT_TRUE (boundary.loop.empty ());
}

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
  CsrLists no_neighbors;
  no_neighbors.offsets.assign (points + 1, 0);
  return manifoldPart (std::move (consensus), no_neighbors, 1, 1);
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
    EXPECT_TRUE (topologyOf (mesh.triangles).manifold);
    EXPECT_EQ (mesh.triangles.size (), 5); // the other one keeps the triangle away from the point
    EXPECT_TRUE (holds (mesh, is_first ? first : second));
  }
}

TEST (ManifoldPart, DropsTheTriangleOfFewerVotesAtADoubleEdge)
{
  const TriangleMesh mesh = partOf ({{{0, 1, 2}}, {{0, 1, 3}}}, {1, 2}, 4);
  EXPECT_EQ (mesh.triangles, (std::vector<Triangle>{{0, 1, 3}}));
}

// A small component beside a larger one is an island, unless it is closed: then it is a body.
TEST (ManifoldPart, HasNoSmallIslandsButBodies)
{
  const std::vector<Triangle> square{{0, 1, 2}, {0, 2, 3}}, body = tetrahedron (4, 5, 6, 7);
  for (const bool is_closed : {true, false}) {
    Consensus consensus;
    consensus.triangles = body;
    if (!is_closed)
      consensus.triangles.resize (1);
    consensus.triangles.insert (consensus.triangles.end (), square.begin (), square.end ());
    consensus.triangles.push_back ({0, 3, 8});
    consensus.triangles.push_back ({3, 9, 8});
    consensus.triangles.push_back ({9, 10, 8});
    consensus.votes.assign (consensus.triangles.size (), 3);
    CsrLists neighbors; // only that point 4 is beside point 0
    neighbors.offsets.assign (5, 0);
    neighbors.offsets.resize (12, 1);
    neighbors.ids = {0};
    const std::size_t all = consensus.triangles.size ();
    EXPECT_EQ (manifoldPart (std::move (consensus), neighbors, 9, 1).triangles.size (),
               is_closed ? all : all - 1);
  }
}

// The places of a crumb of the lattice of 3 x 3 x 3 points, as bits.
using Crumb = std::uint32_t;

// The least of a crumb's 48 images by turns and mirrors.
Crumb
leastImage (Crumb crumb)
{
  static const std::vector<std::array<Index, 27>> symmetries = [] {
    std::vector<std::array<Index, 27>> all;
    std::array<Index, 3> axes{0, 1, 2};
    do
      for (Index mirrors = 0; mirrors < 8; ++mirrors) {
        std::array<Index, 27> to{};
        for (Index i = 0; i < 27; ++i) {
          const std::array<Index, 3> at{i % 3, i / 3 % 3, i / 9};
          for (Index axis = 0, step = 1; axis < 3; ++axis, step *= 3)
            to[i] += step * ((mirrors >> axis & 1U) != 0 ? 2 - at[axes[axis]] : at[axes[axis]]);
        }
        all.push_back (to);
      }
    while (std::next_permutation (axes.begin (), axes.end ()));
    return all;
  }();
  Crumb least = crumb;
  for (const std::array<Index, 27>& to : symmetries) {
    Crumb image = 0;
    for (Index i = 0; i < 27; ++i)
      image |= (crumb >> i & 1U) << to[i];
    least = std::min (least, image);
  }
  return least;
}

// Crumbs may have several closed fans. Each ends as a manifold, or is refused for a reason of its
// own: all of up to 5 points that are distinct, and samples of 6 to 10 around the middle.
// PCL_FLOATER_CRUMBS: all of up to so many points.
TEST (ManifoldPart, CrumbsOfALatticeAreManifold)
{
  constexpr Crumb MIDDLE = 1U << 13U, END = 1U << 27U;
  const char* const more = std::getenv ("PCL_FLOATER_CRUMBS");
  const std::size_t most = more != nullptr ? std::stoul (more) : 5;
  std::set<Crumb> crumbs;
  for (std::size_t size = 3; size <= most; ++size)
    for (Crumb crumb = (1U << size) - 1; crumb < END;) {
      crumbs.insert (leastImage (crumb));
      const Crumb lowest = crumb & (~crumb + 1U),
                  next = crumb + lowest; // as many bits, the next larger
      crumb = next | ((crumb ^ next) / lowest >> 2U);
    }
  EXPECT_GE (crumbs.size (), 2540U); // by Burnside's lemma, of up to 5
  std::mt19937 random (1);
  for (std::size_t i = 0; i < 2000; ++i) {
    Crumb crumb = MIDDLE;
    while (std::bitset<27> (crumb).count () < 6 + i % 5)
      crumb |= 1U << random () % 27;
    crumbs.insert (leastImage (crumb));
  }
  Options options;
  options.threads = 1;
  std::size_t meshes = 0;
  for (const Crumb crumb : crumbs) {
    Positions positions;
    for (Index i = 0; i < 27; ++i)
      if ((crumb >> i & 1U) != 0)
        positions.emplace_back (i % 3, i / 3 % 3, i / 9);
    const Result result = reconstruct (positions, options);
    ASSERT_NE (result.report.status, RunStatus::INTERNAL_ERROR)
        << result.report.message << ": crumb " << crumb;
    ASSERT_TRUE (topologyOf (result.triangles).manifold) << crumb;
    meshes += result.report.status == RunStatus::SUCCESS ? 1 : 0;
  }
  EXPECT_GT (meshes, crumbs.size () / 2);
}

} // namespace
} // namespace pcl::floater
