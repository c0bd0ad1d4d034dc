// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours against trying all points: in blocks, by a tree, by the caller's search, of some points,
// and after points were removed.
#include "points/neighbors.h"

#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

constexpr int NEIGHBORS = 20;
constexpr double RADIUS = 2.5;
const NeighborSettings IN_BALLS{{Neighborhood::BALL, NEIGHBORS, RADIUS}};

/// The k nearest of each point; or, with a radius in spacings, at least 6 and at most 200 of those in a
/// ball.
CsrLists
listsByTryingAll (const Positions& positions, const Rows& rows, std::size_t k, double radius = 0.0)
{
  CsrLists lists;
  lists.offsets.push_back (0);
  for (std::size_t i = 0; i < rows.size (); ++i) {
    std::vector<Neighbor> others = nearestByTryingAll (positions, positions[rows[i]], 202);
    others.erase (std::find_if (others.begin (), others.end (),
                                [&] (const Neighbor& other) { return other.point == rows[i]; }));
    double reach = 0.0;
    for (std::size_t n = 0; n < std::min<std::size_t> (others.size (), 6); ++n)
      reach += radius * std::sqrt (others[n].sqr_distance) / 6.0;
    for (std::size_t n = 0; n < others.size (); ++n)
      if (radius == 0.0 ? n < k : n < 6 || (n < 200 && others[n].sqr_distance <= reach * reach))
        lists.ids.push_back (others[n].point);
    lists.offsets.push_back (static_cast<Index> (lists.ids.size ()));
  }
  return lists;
}

void
expectSame (const CsrLists& found, const CsrLists& expected)
{
  EXPECT_EQ (found.rows (), expected.rows ());
  EXPECT_TRUE (found.offsets == expected.offsets || expected.rows () == 0);
  EXPECT_EQ (found.ids, expected.ids);
}

/// Denser at one side.
Positions
plane (std::size_t count)
{
  Positions points = randomPoints (count, 1);
  for (Eigen::Vector3d& p : points)
    p = {40.0 * p.x () * p.x (), 40.0 * p.y (), 0.0};
  return points;
}

/// The nearest of all points, by a search in each block.
/// \param[in,out] cut_again becomes true if a block was too small
CsrLists
nearestByBlocks (const Positions& positions, std::size_t blocks, bool& cut_again)
{
  const std::vector<BlockCutter::Box> buckets = BlockCutter::makeBuckets (positions);
  const BlockCutter cutter{positions.size (), buckets, std::min (blocks, buckets.size ()),
                           [&positions] (Index first, Index last, Positions& to) {
                             to.insert (to.end (), positions.data () + first,
                                        positions.data () + last);
                           }};
  CsrLists lists;
  lists.offsets.push_back (0);
  for (std::size_t i = 0; i < cutter.blocks; ++i) {
    BlockSearch search (cutter, i);
    const std::size_t before = search.points ().size ();
    const CsrLists found = findNearestOfBlock (search, positions.size (), NEIGHBORS, 2);
    cut_again = cut_again || search.points ().size () > before;
    for (std::size_t r = 0; r < found.rows (); ++r) {
      lists.ids.insert (lists.ids.end (), found.row (r).begin (), found.row (r).end ());
      lists.offsets.push_back (static_cast<Index> (lists.ids.size ()));
    }
  }
  return lists;
}

TEST (NearestNeighbors, DoNotDependOnBlocks)
{
  // Two tori, three small clusters far away, each of fewer points than a point has neighbours, and
  // single points at all distances: halos of an even width are too narrow.
  Positions scattered =
      joined (surface (SurfaceKind::TORUS, 2500),
              placed (surface (SurfaceKind::TORUS, 800), {150.0, 0.0, 20.0}, 0.2));
  for (int cluster = 0; cluster < 3; ++cluster)
    scattered = joined (scattered, placed (randomPoints (9, 7U + static_cast<unsigned> (cluster)),
                                           300.0 * Eigen::Vector3d::Unit (cluster)));
  for (int i = 1; i <= 12; ++i)
    scattered.push_back (polar (100.0, i, 3.0 * i * i));
  std::vector<Positions> clouds;
  for (const Positions& cloud : {scattered, surface (SurfaceKind::HEIGHT_FIELD, 3000, 0.0, 50.0),
                                 surface (SurfaceKind::FOLDED_SHEET, 2000),
                                 surface (SurfaceKind::SPHERE, 2000, 0.3), randomPoints (700, 3)})
    clouds.push_back (workingPoints (cloud).positions);
  for (const std::size_t few : {0U, 1U, 2U, 5U, 20U, 21U, 30U})
    clouds.push_back (randomPoints (few, 6));
  // The squares of such distances underflow to 0: all points of a crowd are equally near, and their
  // order is that of their indices. So a point is not always among its own k + 1 results.
  Positions crowd = randomPoints (200, 8);
  for (int i = 0; i < 60; ++i)
    crowd.emplace_back (-1e-170 * i, 0.0, 0.0);
  clouds.push_back (crowd);
  // Ties, which go by index: a cube, a line, and equal points; and squares that are no normal numbers.
  Positions cube, line, tiny, equal (30, Eigen::Vector3d (1, 2, 3));
  for (const Index i : permutation (1331, 4))
    cube.emplace_back (i % 11, i / 11 % 11, i / 121); // NOLINT (bugprone-integer-division)
  for (const Index i : permutation (500, 6)) {
    line.emplace_back (0.1 * i, -0.2 * i, 0.3 * i);
    tiny.emplace_back (1e-161 * (i % 20), 1e-161 * (i / 20), 0.0); // NOLINT
  }
  equal.resize (130, Eigen::Vector3d (1, 2, 4));
  clouds.insert (clouds.end (), {cube, line, tiny, equal});
  bool cut_again = false;
  for (std::size_t cloud = 0; cloud < clouds.size (); ++cloud) {
    const Positions& positions = clouds[cloud];
    const Rows all = Rows::all (positions.size ());
    const CsrLists expected = listsByTryingAll (positions, all, NEIGHBORS);
    SCOPED_TRACE (cloud);
    expectSame (findNearestNeighbors (positions, all, NEIGHBORS, 2), expected);
    std::vector<Index> many;
    for (Index p = 5; p < positions.size (); p += 1 + p % 13)
      many.push_back (p);
    const std::vector<Index> one (std::min<std::size_t> (positions.size (), 1), 0), none;
    for (const std::vector<Index>& some : {many, one, none}) {
      const CsrLists of_some = listsByTryingAll (positions, Rows::of (some), NEIGHBORS);
      expectSame (findNearestNeighbors (positions, Rows::of (some), NEIGHBORS, 2), of_some);
    }
    for (const std::size_t blocks : {2U, 16U, 64U})
      expectSame (nearestByBlocks (positions, blocks, cut_again), expected);
  }
  EXPECT_TRUE (cut_again);
}

TEST (BallNeighbors, AreTheSixNearestAndUpToTwoHundredInABall)
{
  // A crowd, a point with a ball that holds all of it, and a few with balls of few.
  Positions crowded = placed (randomPoints (1000, 3), {0, 0, 0}, 1e-3);
  crowded.emplace_back (-1.0, 0.0, 0.0);
  crowded.emplace_back (1.0, 0.0, 0.0);
  for (int i = 0; i < 5; ++i)
    crowded.emplace_back (1.0 + 1e-9 * (i + 1), 1e-9 * i * i, 0.0);
  std::set<std::size_t> lengths;
  for (const Positions& cloud : {plane (1500), plane (4), crowded}) {
    const Points points = workingPoints (cloud);
    const Rows all = Rows::all (points.size ());
    const CsrLists balls = findNeighbors (points, IN_BALLS, 2);
    expectSame (balls, listsByTryingAll (points.positions, all, 0, RADIUS));
    for (Index p = 0; p < points.size (); ++p)
      lengths.insert (balls.row (p).size ());
  }
  for (const std::size_t length : {3U, 6U, 20U, 200U})
    EXPECT_EQ (lengths.count (length), 1U) << length;
}

/// A search of the caller that tries all points. Its answers are unordered, have repetitions, the point
/// itself, points that are not in the set, indices beyond the cloud, and within a radius one that is too
/// far away.
class BruteForceSearch : public NeighborSearch
{
public:
  explicit BruteForceSearch (Positions cloud) : cloud_ (std::move (cloud)) {}

  void build (const std::vector<std::uint32_t>& cloud_indices) override
  {
    EXPECT_TRUE (std::is_sorted (cloud_indices.begin (), cloud_indices.end ()));
    chosen = cloud_indices;
    positions_.clear ();
    unknown_ = {static_cast<Index> (cloud_.size ()), NONE};
    for (Index i = 0; i < cloud_.size (); ++i)
      if (std::binary_search (chosen.begin (), chosen.end (), i))
        positions_.push_back (cloud_[i]);
      else
        unknown_.push_back (i);
  }

  void nearest (std::uint32_t cloud_index, int k,
                std::vector<std::uint32_t>& cloud_indices) override
  {
    EXPECT_TRUE (std::binary_search (chosen.begin (), chosen.end (), cloud_index));
    answer (cloud_index, static_cast<std::size_t> (k), KdTree::EVERYWHERE, cloud_indices);
  }

  bool within (std::uint32_t cloud_index, double radius,
               std::vector<std::uint32_t>& cloud_indices) override
  {
    answer (cloud_index, positions_.size (), radius, cloud_indices);
    cloud_indices.push_back (chosen[(cloud_index + 17) % chosen.size ()]);
    return knows_radii;
  }

  std::vector<std::uint32_t> chosen;
  bool knows_radii = false;

private:
  void answer (Index cloud_index, std::size_t k, double radius, std::vector<Index>& answers) const
  {
    answers = unknown_;
    for (const Neighbor& other : nearestByTryingAll (positions_, cloud_[cloud_index], k))
      if (std::sqrt (other.sqr_distance) <= radius)
        answers.insert (answers.end (), 2, chosen[other.point]);
    std::reverse (answers.begin (), answers.end ());
  }

  Positions cloud_, positions_;
  std::vector<std::uint32_t> unknown_;
};

TEST (CallerSearch, FindsTheSameAmongTheWorkingPoints)
{
  for (const std::size_t count : {0U, 1U, 2U, 5U, 20U, 21U, 600U}) {
    SCOPED_TRACE (count);
    Positions cloud = plane (count);
    if (count == 600) {
      cloud[5] = cloud[3];
      cloud[599] = cloud[3];
      cloud[17].x () = std::numeric_limits<double>::quiet_NaN ();
      cloud[0].z () = std::numeric_limits<double>::infinity ();
    }
    const Points points = workingPoints (cloud);
    for (const bool knows_radii : {true, false}) {
      BruteForceSearch search (cloud);
      search.knows_radii = knows_radii;
      NeighborSettings nearest, balls = IN_BALLS;
      nearest.search = balls.search = &search;
      const Rows all = Rows::all (points.size ());
      expectSame (findNeighbors (points, nearest, 1),
                  listsByTryingAll (points.positions, all, NEIGHBORS));
      expectSame (findNeighbors (points, balls, 2),
                  listsByTryingAll (points.positions, all, 0, RADIUS));
      std::vector<Index> wanted = points.cloud_index;
      std::sort (wanted.begin (), wanted.end ());
      EXPECT_EQ (search.chosen, wanted);
    }
  }
}

// Removes each point with the same probability, and the last ones. Expects that lists which are renewed then are those
// that a search finds.
void
expectRenewed (const Positions& cloud, const std::vector<double>& shares, std::size_t last = 0,
               bool by_caller = false)
{
  const Points all = workingPoints (cloud);
  BruteForceSearch search (cloud);
  NeighborSettings nearest, few, balls;
  few.options.k = 6;
  balls.options.kind = Neighborhood::BALL_DELAUNAY;
  for (NeighborSettings settings : {nearest, few, balls}) {
    settings.search = by_caller ? &search : nullptr;
    const CsrLists before = findNeighbors (all, settings, 1);
    for (const double share : shares)
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        RandomStream random (seed);
        std::vector<Index> removed;
        for (Index p = 0; p < all.size (); ++p)
          if (random.uniform () < share || all.cloud_index[p] + last >= cloud.size ())
            removed.push_back (p);
        Points left = all;
        removePoints (left, removed);
        if (last > 0) { // the box shrinks, and positions are scaled again
          EXPECT_LT (left.scale, 0.1 * all.scale);
        }
        const CsrLists expected = findNeighbors (left, settings, 1);
        for (const int threads : {1, 3})
          expectSame (renewNeighbors (left, removed, before, settings, threads), expected);
      }
  }
}

TEST (RenewNeighbors, FindsTheSameAsANewSearch)
{
  expectRenewed (randomPoints (1500, 1), {0.0, 0.001, 0.02, 0.3, 0.9});
  for (const std::size_t count : {1U, 2U, 5U, 12U, 25U})
    expectRenewed (randomPoints (count, count), {0.3, 1.0});
  // A grid is full of equal distances, where indices decide which points are the neighbours.
  Positions grid;
  for (const Index i : permutation (1000, 2))
    grid.emplace_back (i % 10, i / 10 % 10, i / 100); // NOLINT (bugprone-integer-division)
  expectRenewed (grid, {0.01, 0.2});
  RandomStream random (3);
  for (const double jitter : {0.0, 0.3})
    expectRenewed (joined (jitteredGrid (30, 30, 1.0, jitter, random),
                           {{15.3, 14.8, 700.0}, {-90.0, 14.8, 3.0}, {15.1, 500.0, -33.0}}),
                   {0.0, 0.05}, 3);
  expectRenewed (joined (randomPoints (400, 5), Positions{{60.0, 0.0, 0.0}}), {0.05}, 1, true);
}

} // namespace
} // namespace pcl::floater
