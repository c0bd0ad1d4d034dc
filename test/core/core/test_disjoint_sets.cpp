// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/disjoint_sets.h"

#include "random_stream.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
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
