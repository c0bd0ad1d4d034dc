// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/neighbors.h"

#include "points/point_samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using samples::BruteForceSearch;
using samples::indices;
using samples::Positions;

// The k nearest of all points, by the core's own tree.
CsrLists
byTree (const Points& points, int k, const RunContext& run = 1)
{
  return findNearestNeighbors (points.positions, Rows::all (points.size ()), k, 1, run);
}

// The same by a search structure of the caller's.
CsrLists
bySearch (const Points& points, int k, NeighborSearch& search)
{
  CallerSearch caller (points, search);
  return searchNearestNeighbors (caller, Rows::all (points.size ()), k, 1);
}

void
expectEqual (const CsrLists& a, const CsrLists& b)
{
  EXPECT_EQ (a.offsets, b.offsets);
  EXPECT_EQ (a.ids, b.ids);
}

TEST (NearestNeighbors, CallersSearchIsBuiltAmongTheWorkingPoints)
{
  Positions cloud = samples::randomPoints (600, 2);
  cloud[5] = cloud[3];
  cloud[599] = cloud[3];
  cloud[17].x () = std::numeric_limits<double>::quiet_NaN ();
  cloud[0].z () = std::numeric_limits<double>::infinity ();
  const Points points = makePoints (cloud, indices (cloud.size ()), 1);
  BruteForceSearch search (cloud);
  const CsrLists neighbors = bySearch (points, 12, search);
  std::vector<Index> expected = points.cloud_index;
  std::sort (expected.begin (), expected.end ());
  EXPECT_EQ (search.chosen, expected);
  expectEqual (neighbors, byTree (points, 12));
}

TEST (NearestNeighbors, RepeatedAnswersCountOnce)
{
  const Positions cloud = samples::randomPoints (100, 3);
  const Points points = makePoints (cloud, indices (cloud.size ()), 1);
  BruteForceSearch search (cloud);
  search.answers_each = 2;
  expectEqual (bySearch (points, 8, search), byTree (points, 8));
}

TEST (NearestNeighbors, AnswersOutsideTheWorkingSetAreIgnored)
{
  class Careless : public NeighborSearch
  {
    void build (const std::vector<std::uint32_t>&) override {}
    void nearest (std::uint32_t, int, std::vector<std::uint32_t>& cloud_indices) override
    {
      cloud_indices = {0, 1, 2, 3, 4, 77, std::numeric_limits<std::uint32_t>::max ()};
    }
  } search;
  Positions cloud = samples::randomPoints (5, 4);
  cloud[2].y () = std::numeric_limits<double>::quiet_NaN ();
  const Points points = makePoints (cloud, indices (cloud.size ()), 1);
  const CsrLists neighbors = bySearch (points, 20, search);
  ASSERT_EQ (neighbors.rows (), 4U);
  for (std::size_t p = 0; p < 4; ++p) {
    std::vector<Index> row (neighbors.row (p).begin (), neighbors.row (p).end ());
    std::sort (row.begin (), row.end ());
    std::vector<Index> others = indices (4);
    others.erase (others.begin () + static_cast<std::ptrdiff_t> (p));
    EXPECT_EQ (row, others);
  }
}

// Rows for some of the points are the same as those for all, whichever way they are searched.
TEST (NearestNeighbors, OfSomePointsAreRowsOfThoseOfAll)
{
  const Positions cloud = samples::randomPoints (700, 7);
  const Points points = makePoints (cloud, indices (cloud.size ()), 1);
  const CsrLists all = byTree (points, 15);
  std::vector<Index> chosen;
  for (Index p = 5; p < points.size (); p += 1 + p % 13)
    chosen.push_back (p);
  for (const std::vector<Index>& asked : {chosen, std::vector<Index>{}, std::vector<Index>{699}}) {
    const Rows rows = Rows::of (asked);
    BruteForceSearch search (cloud);
    CallerSearch caller (points, search);
    const CsrLists by_search = searchNearestNeighbors (caller, rows, 15, 1);
    for (const std::size_t blocks : {1U, 4U}) {
      const CsrLists some = findNearestNeighbors (points.positions, rows, 15, blocks, 2);
      expectEqual (by_search, some);
      ASSERT_EQ (some.rows (), asked.size ());
      for (std::size_t i = 0; i < asked.size (); ++i)
        ASSERT_TRUE (std::equal (some.row (i).begin (), some.row (i).end (),
                                 all.row (asked[i]).begin (), all.row (asked[i]).end ()));
    }
  }
}

// The squares of such distances underflow to 0: all points of a crowd are equally near, and their
// order is that of their indices. So a point with k + 1 others before it is not among its own k + 1
// results. Its row must not become longer by that, not even the last row of all.
TEST (NearestNeighbors, DistancesWhoseSquaresUnderflow)
{
  constexpr Index OTHERS = 200, CROWD = 60;
  constexpr int K = 12;
  Positions positions = samples::randomPoints (OTHERS, 8);
  for (int i = 0; i < static_cast<int> (CROWD); ++i)
    positions.emplace_back (-1e-170 * i, 0.0, 0.0);
  for (const std::size_t blocks : {1U, 3U}) {
    const CsrLists neighbors =
        findNearestNeighbors (positions, Rows::all (positions.size ()), K, blocks, 1);
    ASSERT_EQ (neighbors.rows (), positions.size ());
    ASSERT_EQ (neighbors.ids.size (), positions.size () * K);
    for (Index p = OTHERS; p < positions.size (); ++p) {
      std::vector<Index> expected;
      for (Index q = OTHERS; expected.size () < K; ++q)
        if (q != p)
          expected.push_back (q);
      const Row row = neighbors.row (p);
      EXPECT_EQ (std::vector<Index> (row.begin (), row.end ()), expected) << p;
    }
    for (Index p = 0; p < OTHERS; ++p) {
      const Row row = neighbors.row (p);
      EXPECT_EQ (std::count (row.begin (), row.end (), p), 0);
    }
  }
}

TEST (NearestNeighbors, FewerWhereThereAreFewerPoints)
{
  for (const std::size_t count : {0U, 1U, 2U, 5U, 20U, 21U}) {
    const Positions cloud = samples::randomPoints (count, 6);
    const Points points = makePoints (cloud, indices (count), 1);
    BruteForceSearch search (cloud);
    const CsrLists neighbors = byTree (points, 20);
    EXPECT_EQ (neighbors.rows (), count);
    EXPECT_EQ (neighbors.ids.size (), count * (std::max<std::size_t> (count, 1) - 1));
    expectEqual (bySearch (points, 20, search), neighbors);
  }
}

} // namespace
} // namespace pcl::floater
