// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The common orientation of normals.
#include "consensus/orientation.h"

#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
// A candidate by the normals of its corners: bit i of `down` is set if normal i points down.
Candidate
candidate (const Triangle& corners, std::uint8_t down, std::uint8_t votes = 3)
{
  return {corners, votes, down, 1.0F, 1.0F};
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

TEST (Orientation, TurnsNormalsToOneSide)
{
  // A strip of triangles over points with normals at random, each given as it is seen there.
  constexpr Index POINTS = 100;
  RandomStream random (1);
  std::vector<std::uint8_t> down (POINTS);
  for (std::uint8_t& side : down)
    side = static_cast<std::uint8_t> (random.below (2));
  Orientation orientation (POINTS);
  for (const Index p : samples::permutation (POINTS - 2, 2)) {
    const auto clockwise =
        static_cast<std::uint8_t> (down[p] | (down[p + 1] << 1U) | (down[p + 2] << 2U));
    EXPECT_TRUE (orientation.join ({p, p + 1, p + 2}, clockwise));
    // The other way round it contradicts.
    EXPECT_FALSE (orientation.join ({p, p + 1, p + 2}, static_cast<std::uint8_t> (clockwise ^ 1U)));
  }
  std::vector<std::uint8_t> sides = sidesOf (orientation, POINTS);
  for (Index p = 0; p < POINTS; ++p)
    EXPECT_EQ (sides[p] ^ sides[0], down[p] ^ down[0]);
  // All triangles face to one side then.
  const Triangle first = orientation.turned ({0, 1, 2}, static_cast<std::uint8_t> (down[0]));
  for (Index p = 0; p + 2 < POINTS; ++p) {
    const Triangle turned = orientation.turned ({p, p + 1, p + 2}, down[p]);
    EXPECT_EQ (turned == (Triangle{p, p + 1, p + 2}), first == (Triangle{0, 1, 2}));
  }
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

TEST (Orientation, VotesJoinAllThatCandidatesConnect)
{
  // A row of single points, each tied to the next one by one candidate with a known side.
  constexpr Index POINTS = 200;
  RandomStream random (3);
  std::vector<Candidate> candidates;
  std::vector<std::uint8_t> down (POINTS);
  for (std::uint8_t& side : down)
    side = static_cast<std::uint8_t> (random.below (2));
  for (const Index p : samples::permutation (POINTS - 2, 4))
    candidates.push_back (
        candidate ({p, p + 1, p + 2},
                   static_cast<std::uint8_t> (down[p] | (down[p + 1] << 1U) | (down[p + 2] << 2U)),
                   static_cast<std::uint8_t> (1 + random.below (3))));
  Orientation orientation (POINTS + 1); // and a point without candidates
  vote (orientation, candidates);
  const std::vector<std::uint8_t> sides = sidesOf (orientation, POINTS + 1);
  for (Index p = 0; p < POINTS; ++p)
    EXPECT_EQ (sides[p] ^ sides[0], down[p] ^ down[0]);
  EXPECT_EQ (sides[POINTS], 0U);
}

} // namespace
} // namespace pcl::floater
