// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What all stages use: lists of lists, disjoint sets, ranks, areas and folds, and parallel loops.
#include "core/csr_lists.h"
#include "core/disjoint_sets.h"
#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace pcl::floater {
namespace {
std::vector<Index>
asVector (Row row)
{
  return {row.begin (), row.end ()};
}

TEST (CsrLists, AreWhatListsOfListsAre)
{
  RandomStream random (1);
  for (int round = 0; round < 50; ++round) {
    const std::size_t rows = random.below (30);
    std::vector<std::pair<std::size_t, Index>> entries (
        round % 5 == 0 || rows == 0 ? 0 : random.below (200));
    std::vector<std::vector<Index>> expected (rows);
    for (auto& [row, id] : entries) {
      row = random.below (rows);
      id = static_cast<Index> (random.below (1000));
      expected[row].push_back (id);
    }
    const CsrLists lists = makeCsrLists (rows, [&] (const auto& emit) {
      for (const auto& [row, id] : entries)
        emit (row, id);
    });
    ASSERT_EQ (lists.rows (), rows);
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<Index>& list = expected[row];
      ASSERT_EQ (asVector (lists.row (row)), list);
      EXPECT_EQ (asVector (lists.first (row, 200)), list);
      list.resize (std::min<std::size_t> (list.size (), 3));
      EXPECT_EQ (asVector (lists.first (row, 3)), list);
      EXPECT_EQ (lists.first (row, 0).size (), 0U);
    }
  }
  EXPECT_EQ (CsrLists{}.rows (), 0U);
  std::vector<Index> offsets{0, 3, 0, 2};
  sumRowLengths (offsets);
  EXPECT_EQ (offsets, (std::vector<Index>{0, 3, 3, 5}));
}

TEST (CsrLists, BeginsBeyondFourBillionEntries)
{
  constexpr std::size_t LONG = 3'000'000'000; // a row so long that few rows have many entries
  CsrLists lists;
  std::vector<std::size_t> begins;
  for (std::size_t r = 0; r <= 9; ++r) {
    begins.push_back (r < 5 ? r * LONG : (r - 1) * LONG + 5); // row 4 has five entries
    lists.offsets.push_back (static_cast<Index> (begins.back ()));
  }
  lists.findWraps ();
  for (std::size_t r = 0; r <= 9; ++r)
    EXPECT_EQ (lists.begin (r), begins[r]) << r;
  lists.offsets = {0, 3, 3, 7};
  lists.findWraps ();
  EXPECT_TRUE (lists.wraps.empty ());
  EXPECT_EQ (lists.begin (3), 7U);
}

// Sets against relabelling all members; signed sets against a colouring that the joins agree with.
TEST (DisjointSets, AreThoseOfRelabelling)
{
  constexpr std::size_t SIZE = 70;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random (seed);
    DisjointSets sets (SIZE);
    SignedSets signed_sets (SIZE);
    std::vector<Index> label (SIZE);
    std::iota (label.begin (), label.end (), Index{0});
    std::vector<bool> colour (SIZE);
    for (std::size_t i = 0; i < SIZE; ++i)
      colour[i] = random.below (2) == 1;
    for (int joins = 0; joins < 100; ++joins) {
      const auto a = static_cast<Index> (random.below (SIZE));
      const auto b = static_cast<Index> (random.below (SIZE));
      const bool opposite = colour[a] != colour[b];
      if (label[a] == label[b]) {
        EXPECT_FALSE (signed_sets.join (a, b, !opposite)) << "contradicts";
      }
      EXPECT_TRUE (signed_sets.join (a, b, opposite));
      EXPECT_EQ (sets.join (a, b), label[a] != label[b]);
      const Index smaller = std::min (label[a], label[b]), larger = std::max (label[a], label[b]);
      std::replace (label.begin (), label.end (), larger, smaller);
      for (Index i = 0; i < SIZE; ++i)
        ASSERT_EQ (sets.find (i), label[i]);
    }
    for (Index a = 0; a < SIZE; ++a)
      for (Index b = 0; b < a; ++b) {
        const SignedSets::Place at_a = signed_sets.find (a), at_b = signed_sets.find (b);
        ASSERT_EQ (at_a.root == at_b.root, label[a] == label[b]);
        if (at_a.root == at_b.root) {
          ASSERT_EQ (at_a.flipped != at_b.flipped, colour[a] != colour[b]);
        }
      }
  }
}

// All ranks of lists of every size up to 40, whose numbers are different or mostly equal.
TEST (OrderStatistics, TwoRanksAreThoseOfTheSortedList)
{
  RandomStream random (1);
  for (const std::size_t different : {1U, 3U, 1000U})
    for (std::size_t count = 1; count <= 40; ++count) {
      std::vector<double> numbers (count);
      for (double& value : numbers)
        value = static_cast<double> (random.below (different));
      std::vector<double> sorted = numbers;
      std::sort (sorted.begin (), sorted.end ());
      for (std::size_t high = 0; high < count; ++high)
        for (std::size_t low = 0; low <= high; ++low) {
          std::vector<double> values = numbers;
          ASSERT_EQ (valuesAtRanks (values, low, high), std::make_pair (sorted[low], sorted[high]))
              << count << " numbers, ranks " << low << " and " << high;
        }
    }
}

// Normals at this angle, in degrees, of any lengths.
void
expectFoldAt (double angle, bool is_fold)
{
  const Eigen::Vector3d axis = Eigen::Vector3d (1.0, -2.0, 0.5).normalized ();
  const Eigen::Vector3d normal = axis.unitOrthogonal ();
  const Eigen::Vector3d other = Eigen::AngleAxisd (angle * DEGREE, axis) * normal;
  for (const double length : {1e-60, 1e-9, 1.0, 3.0, 1e60})
    for (const double other_length : {1e-60, 0.7, 1.0, 1e60}) {
      EXPECT_EQ (isFold (length * normal, other_length * other), is_fold) << angle << length;
      EXPECT_EQ (isFold (other_length * other, length * normal), is_fold) << angle << length;
    }
}

TEST (IsFold, FromOneHundredAndTwentyDegreesOnAndNotWithoutArea)
{
  for (const double flat : {0.0, 30.0, 60.0, 61.0, 90.0, 119.0, 119.999})
    expectFoldAt (flat, false);
  for (const double folded : {120.001, 121.0, 150.0, 180.0})
    expectFoldAt (folded, true);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero (), up = Eigen::Vector3d::UnitZ ();
  EXPECT_FALSE (isFold (zero, up));
  EXPECT_FALSE (isFold (-up, zero));
  EXPECT_FALSE (isFold (zero, zero));
  // Three points on a line make a triangle without area.
  EXPECT_FALSE (isFold (areaVector ({0, 0, 0}, {1, 1, 1}, {3, 3, 3}), up));
}

TEST (AreaVector, PointsToTheSideFromWhichCornersRunAnticlockwise)
{
  EXPECT_EQ (areaVector ({1, 1, 5}, {3, 1, 5}, {1, 4, 5}), Eigen::Vector3d (0, 0, 6));
  EXPECT_EQ (areaVector ({1, 1, 5}, {1, 4, 5}, {3, 1, 5}), Eigen::Vector3d (0, 0, -6));
  EXPECT_EQ (cross (Eigen::Vector2d (2, 0), Eigen::Vector2d (5, 3)), 6.0) << "to the left";
  EXPECT_EQ (cross (Eigen::Vector2d (5, 3), Eigen::Vector2d (2, 0)), -6.0) << "to the right";
  EXPECT_EQ (cross (Eigen::Vector2d (2, -1), Eigen::Vector2d (-6, 3)), 0.0);
}

TEST (Parallel, TasksAndRangesCoverAllOnce)
{
  for (const int threads : {1, 2, 7})
    for (const std::size_t count : {0U, 1U, 2U, 5U, 1000U, 1023U, 1024U, 1025U, 10000U}) {
      std::vector<std::atomic<int>> runs (count);
      parallelTasks (threads, count, [&runs] (std::size_t i) { ++runs[i]; });
      parallelRanges (threads, count, [&] (std::size_t first, std::size_t last) {
        EXPECT_EQ (first % RANGE_LENGTH, 0U);
        EXPECT_EQ (last, std::min (count, first + RANGE_LENGTH));
        for (std::size_t i = first; i < last; ++i)
          runs[i] += 10;
      });
      for (const std::atomic<int>& of_one : runs)
        ASSERT_EQ (of_one, 11);
    }
}

TEST (Parallel, RethrowsWhatATaskThrows)
{
  for (const int threads : {1, 2, 5}) {
    EXPECT_THROW (parallelTasks (threads, 8, [] (std::size_t) { throw std::bad_alloc (); }),
                  std::bad_alloc);
    std::atomic<int> begun{0};
    const auto failAtOnce = [&begun] (std::size_t) {
      ++begun;
      throw std::runtime_error ("in a task");
    };
    EXPECT_THROW (parallelTasks (threads, 100000, failAtOnce), std::runtime_error);
    EXPECT_LE (begun, threads) << "no task begins after the first error";
  }
}

} // namespace
} // namespace pcl::floater
