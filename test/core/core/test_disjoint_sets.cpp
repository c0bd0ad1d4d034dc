// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/disjoint_sets.h"

#include "random_stream.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
TEST (DisjointSets, TheSmallestElementRepresentsASet)
{
  DisjointSets sets (8);
  for (Index i = 0; i < 8; ++i)
    EXPECT_EQ (sets.find (i), i);
  EXPECT_TRUE (sets.join (7, 5));
  EXPECT_TRUE (sets.join (3, 7));
  EXPECT_TRUE (sets.join (6, 2));
  EXPECT_FALSE (sets.join (5, 3)) << "7 has joined them";
  EXPECT_FALSE (sets.join (4, 4));
  for (const Index i : {3U, 5U, 7U})
    EXPECT_EQ (sets.find (i), 3U);
  EXPECT_TRUE (sets.join (2, 5));
  for (const Index i : {2U, 3U, 5U, 6U, 7U})
    EXPECT_EQ (sets.find (i), 2U);
  EXPECT_EQ (sets.find (4), 4U);
}

TEST (DisjointSets, AreThoseOfRelabelling)
{
  constexpr std::size_t SIZE = 60;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random (seed);
    DisjointSets sets (SIZE);
    std::vector<Index> label (SIZE);
    std::iota (label.begin (), label.end (), Index{0});
    for (int joins = 0; joins < 80; ++joins) {
      const auto a = static_cast<Index> (random.below (SIZE));
      const auto b = static_cast<Index> (random.below (SIZE));
      EXPECT_EQ (sets.join (a, b), label[a] != label[b]);
      const Index smaller = std::min (label[a], label[b]), larger = std::max (label[a], label[b]);
      std::replace (label.begin (), label.end (), larger, smaller);
      for (Index i = 0; i < SIZE; ++i)
        ASSERT_EQ (sets.find (i), label[i]);
    }
  }
}

TEST (SignedSets, SignsAddUpAlongTheWay)
{
  SignedSets sets (6);
  EXPECT_TRUE (sets.join (0, 1, true));
  EXPECT_TRUE (sets.join (1, 2, true));
  EXPECT_TRUE (sets.join (2, 3, false));
  const auto differ = [&sets] (Index a, Index b) {
    EXPECT_EQ (sets.find (a).root, sets.find (b).root);
    return sets.find (a).flipped != sets.find (b).flipped;
  };
  EXPECT_TRUE (differ (0, 1));
  EXPECT_FALSE (differ (0, 2));
  EXPECT_FALSE (differ (0, 3));
  EXPECT_TRUE (differ (1, 3));
  EXPECT_NE (sets.find (4).root, sets.find (0).root);
  EXPECT_FALSE (sets.find (5).flipped) << "a set of one element";
}

TEST (SignedSets, AContradictionIsReturnedAndChangesNothing)
{
  SignedSets sets (3);
  EXPECT_TRUE (sets.join (0, 1, false));
  EXPECT_TRUE (sets.join (1, 2, true));
  EXPECT_TRUE (sets.join (0, 2, true)) << "agrees with the first two";
  EXPECT_FALSE (sets.join (0, 2, false));
  EXPECT_TRUE (sets.join (2, 1, true)) << "a contradiction changes nothing";
  EXPECT_TRUE (sets.join (1, 1, false));
  EXPECT_FALSE (sets.join (1, 1, true));
}

TEST (SignedSets, AgreeWithAColouring)
{
  constexpr std::size_t SIZE = 80;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random (seed);
    std::vector<bool> colour (SIZE);
    for (std::size_t i = 0; i < SIZE; ++i)
      colour[i] = random.below (2) == 1;
    SignedSets sets (SIZE);
    DisjointSets plain (SIZE);
    for (int joins = 0; joins < 120; ++joins) {
      const auto a = static_cast<Index> (random.below (SIZE));
      const auto b = static_cast<Index> (random.below (SIZE));
      const bool opposite = colour[a] != colour[b];
      if (plain.find (a) == plain.find (b)) {
        EXPECT_FALSE (sets.join (a, b, !opposite)) << "contradicts";
      }
      EXPECT_TRUE (sets.join (a, b, opposite));
      plain.join (a, b);
    }
    for (Index a = 0; a < SIZE; ++a)
      for (Index b = 0; b < a; ++b) {
        const SignedSets::Place at_a = sets.find (a), at_b = sets.find (b);
        ASSERT_EQ (at_a.root == at_b.root, plain.find (a) == plain.find (b));
        if (at_a.root == at_b.root) {
          ASSERT_EQ (at_a.flipped != at_b.flipped, colour[a] != colour[b]);
        }
      }
  }
}

} // namespace
} // namespace pcl::floater
