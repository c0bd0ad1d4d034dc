// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/csr_lists.h"

#include "random_stream.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
std::vector<Index>
asVector (Row row)
{
  return {row.begin (), row.end ()};
}

TEST (CsrLists, WithoutEntriesAndWithoutRows)
{
  const auto nothing = [] (const auto& /*emit*/) {};
  const CsrLists empty_rows = makeCsrLists (3, nothing);
  EXPECT_EQ (empty_rows.rows (), 3U);
  for (std::size_t row = 0; row < 3; ++row)
    EXPECT_EQ (empty_rows.row (row).size (), 0U);
  EXPECT_EQ (makeCsrLists (0, nothing).rows (), 0U);
  EXPECT_EQ (CsrLists{}.rows (), 0U);
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

TEST (CsrLists, FirstEntriesOfARow)
{
  const CsrLists lists = makeCsrLists (2, [] (const auto& emit) {
    for (Index id = 10; id < 14; ++id)
      emit (1, id);
  });
  EXPECT_EQ (asVector (lists.first (1, 0)), std::vector<Index>{});
  EXPECT_EQ (asVector (lists.first (1, 3)), (std::vector<Index>{10, 11, 12}));
  EXPECT_EQ (asVector (lists.first (1, 4)), (std::vector<Index>{10, 11, 12, 13}));
  EXPECT_EQ (asVector (lists.first (1, 100)), (std::vector<Index>{10, 11, 12, 13}));
  EXPECT_EQ (lists.first (0, 5).size (), 0U);
}

TEST (CsrLists, AreWhatListsOfListsAre)
{
  RandomStream random (1);
  for (int round = 0; round < 50; ++round) {
    const std::size_t rows = 1 + random.below (30);
    std::vector<std::pair<std::size_t, Index>> entries (random.below (200));
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
    for (std::size_t row = 0; row < rows; ++row)
      ASSERT_EQ (asVector (lists.row (row)), expected[row]);
  }
}

TEST (CsrLists, RowLengthsBecomeOffsets)
{
  std::vector<Index> offsets{0, 3, 0, 2};
  sumRowLengths (offsets);
  EXPECT_EQ (offsets, (std::vector<Index>{0, 3, 3, 5}));
}

} // namespace
} // namespace pcl::floater
