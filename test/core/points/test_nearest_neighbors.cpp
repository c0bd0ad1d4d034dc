// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/nearest_neighbors.h"

#include "points/points.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl
{
namespace floater
{
namespace
{
using samples::indices;
using samples::Positions;

// Brute force, answering in the order of the cloud, with the query among the answers.
class BruteForceSearch : public NeighborSearch
{
public:
  explicit BruteForceSearch (Positions cloud) : cloud_ (std::move (cloud)) {}

  void build (const std::vector<std::uint32_t>& cloud_indices) override
  {
    EXPECT_TRUE (std::is_sorted (cloud_indices.begin (), cloud_indices.end ()));
    chosen = cloud_indices;
  }

  void nearest (std::uint32_t cloud_index, int k,
                std::vector<std::uint32_t>& cloud_indices) override
  {
    EXPECT_TRUE (std::binary_search (chosen.begin (), chosen.end (), cloud_index));
    std::vector<std::pair<double, Index>> all;
    for (const Index q : chosen)
      all.emplace_back ((cloud_[q] - cloud_[cloud_index]).squaredNorm (), q);
    std::sort (all.begin (), all.end ());
    all.resize (std::min (all.size (), static_cast<std::size_t> (k)));
    cloud_indices.clear ();
    for (const auto& neighbor : all)
      for (int copy = 0; copy < answers_each; ++copy)
        cloud_indices.push_back (neighbor.second);
    std::sort (cloud_indices.begin (), cloud_indices.end ());
  }

  std::vector<std::uint32_t> chosen;
  int answers_each = 1;

private:
  Positions cloud_;
};

void
expectEqual (const CsrLists& a, const CsrLists& b)
{
  EXPECT_EQ (a.offsets, b.offsets);
  EXPECT_EQ (a.ids, b.ids);
}

TEST (NearestNeighbors, OwnTreeIsBruteForce)
{
  const Positions cloud = samples::randomPoints (400, 1);
  const Points set = makePoints (cloud, indices (cloud.size ()), 1);
  const CsrLists neighbors = findNearestNeighbors (set, 20, nullptr, 1);
  ASSERT_EQ (neighbors.rows (), cloud.size ());
  for (std::size_t p = 0; p < cloud.size (); ++p) {
    std::vector<std::pair<double, Index>> all;
    for (Index q = 0; q < cloud.size (); ++q)
      if (q != p)
        all.emplace_back ((points.positions[q] - points.positions[p]).squaredNorm (), q);
    std::sort (all.begin (), all.end ());
    ASSERT_EQ (neighbors.row (p).size (), 20U);
    for (std::size_t i = 0; i < 20; ++i)
      ASSERT_EQ (neighbors.row (p)[i], all[i].second);
  }
}

TEST (NearestNeighbors, TheCallersSearchSeesTheWorkingPointsOnly)
{
  Positions cloud = samples::randomPoints (600, 2);
  cloud[5] = cloud[3];
  cloud[599] = cloud[3];
  cloud[17].x () = std::numeric_limits<double>::quiet_NaN ();
  cloud[0].z () = std::numeric_limits<double>::infinity ();
  const Points set = makePoints (cloud, indices (cloud.size ()), 1);
  BruteForceSearch search (cloud);
  const CsrLists neighbors = findNearestNeighbors (set, 12, &search, 1);
  std::vector<Index> expected = points.cloud_index;
  std::sort (expected.begin (), expected.end ());
  EXPECT_EQ (search.chosen, expected);
  expectEqual (neighbors, findNearestNeighbors (set, 12, nullptr, 1));
}

TEST (NearestNeighbors, RepeatedAnswersCountOnce)
{
  const Positions cloud = samples::randomPoints (100, 3);
  const Points set = makePoints (cloud, indices (cloud.size ()), 1);
  BruteForceSearch search (cloud);
  search.answers_each = 2;
  expectEqual (findNearestNeighbors (set, 8, &search, 1),
               findNearestNeighbors (set, 8, nullptr, 1));
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
  const Points set = makePoints (cloud, indices (cloud.size ()), 1);
  const CsrLists neighbors = findNearestNeighbors (set, 20, &search, 1);
  ASSERT_EQ (neighbors.rows (), 4U);
  for (std::size_t p = 0; p < 4; ++p) {
    std::vector<Index> row (neighbors.row (p).begin (), neighbors.row (p).end ());
    std::sort (row.begin (), row.end ());
    std::vector<Index> others = indices (4);
    others.erase (others.begin () + static_cast<std::ptrdiff_t> (p));
    EXPECT_EQ (row, others);
  }
}

TEST (NearestNeighbors, ThreadsDoNotMatter)
{
  const Positions cloud = samples::randomPoints (5000, 5);
  const Points set = makePoints (cloud, indices (cloud.size ()), 1);
  const CsrLists expected = findNearestNeighbors (set, 20, nullptr, 1);
  for (const int threads : {0, 2, 5})
    expectEqual (findNearestNeighbors (set, 20, nullptr, threads), expected);
}

TEST (NearestNeighbors, FewerWhereTheSetHasFewer)
{
  for (const std::size_t count : {0U, 1U, 2U, 5U, 20U, 21U}) {
    const Positions cloud = samples::randomPoints (count, 6);
    const Points set = makePoints (cloud, indices (count), 1);
    BruteForceSearch search (cloud);
    const CsrLists neighbors = findNearestNeighbors (set, 20, nullptr, 1);
    EXPECT_EQ (neighbors.rows (), count);
    EXPECT_EQ (neighbors.ids.size (), count * (std::max<std::size_t> (count, 1) - 1));
    expectEqual (findNearestNeighbors (set, 20, &search, 1), neighbors);
  }
}

} // namespace
} // namespace floater
} // namespace pcl
