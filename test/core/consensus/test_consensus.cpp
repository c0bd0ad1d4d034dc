// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The common orientation of normals, and the boundary loop of a disc as a loop of
// the triangles that stars agree on.
#include "consensus/consensus_method.h"
#include "consensus/orientation.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
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

using samples::Neighborhoods;
using samples::Sheet;

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
  const samples::Outline rim = samples::circle (1.0, 0.06), hole = samples::circle (0.4, 0.06);
  for (const std::vector<samples::Outline>& outlines :
       {std::vector<samples::Outline>{rim}, std::vector<samples::Outline>{rim, hole}}) {
    const Sheet sheet = samples::fillOutlines (outlines, 0.06, 0.35, 6);
    const Neighborhoods made = samples::makeNeighborhoods (sheet.positions);
    const std::vector<Eigen::Vector3f> normals = made.geometry.stars.normals;
    const Boundary boundary = find (made);
    EXPECT_FALSE (boundary.problem);
    std::vector<Index> loop;
    for (const Index p : boundary.loop)
      loop.push_back (made.points.cloud_index[p]);
    EXPECT_EQ (samples::canonicalCycle (loop), samples::indices (sheet.border));
    EXPECT_GE (boundary.candidates, sheet.border + (outlines.size () - 1) * hole.size ());
    EXPECT_LT (boundary.largest_step, 2.0);
    EXPECT_EQ (made.geometry.stars.normals, normals);
  }
}

TEST (ConsensusLoop, OfAClosedSurfaceIsEmpty)
{
  const Boundary boundary = find (samples::makeNeighborhoods (samples::evenSphere (1500)));
  EXPECT_EQ (boundary.problem.status, RunStatus::NO_BOUNDARY);
  EXPECT_FALSE (boundary.problem.message.empty ());
  EXPECT_TRUE (boundary.loop.empty ());
}

} // namespace
} // namespace pcl::floater
