// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/domain.h"

#include "local/stars.h"
#include "random_stream.h"
#include "triangulated_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <set>
#include <vector>

namespace pcl::floater {
namespace {
using Lists = std::vector<std::vector<Index>>;
using Links = std::vector<std::array<Index, 2>>;

CsrLists
flatten (const Lists& lists)
{
  CsrLists flat;
  flat.offsets.push_back (0);
  for (const auto& list : lists) {
    flat.ids.insert (flat.ids.end (), list.begin (), list.end ());
    flat.offsets.push_back (static_cast<Index> (flat.ids.size ()));
  }
  return flat;
}

Lists
unflatten (const CsrLists& flat)
{
  Lists lists;
  for (std::size_t p = 0; p < flat.rows (); ++p)
    lists.emplace_back (flat.row (p).begin (), flat.row (p).end ());
  return lists;
}

// The definition instead of the algorithm: follows the rows until nothing changes.
std::vector<std::uint8_t>
reachableByDefinition (const Lists& rows, const std::vector<Index>& loop)
{
  std::vector<std::uint8_t> reachable (rows.size (), 0);
  for (const Index p : loop)
    reachable[p] = 1;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t p = 0; p < rows.size (); ++p)
      if (reachable[p] == 0 && std::any_of (rows[p].begin (), rows[p].end (),
                                            [&] (Index q) { return reachable[q] != 0; })) {
        reachable[p] = 1;
        changed = true;
      }
  }
  return reachable;
}

std::vector<std::uint8_t>
reachableWithLinks (Lists rows, const Links& links, const std::vector<Index>& loop)
{
  for (const auto& link : links)
    rows[link[0]].push_back (link[1]);
  return reachableByDefinition (rows, loop);
}

// A line of points one apart.
std::vector<Eigen::Vector3d>
line (std::size_t count)
{
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t i = 0; i < count; ++i)
    positions.emplace_back (static_cast<double> (i), 0.0, 0.0);
  return positions;
}

// The rows of a grid without all pairs of which one point is inside of a square and one is outside.
Lists
cutOut (const TriangulatedGrid& grid, double from, double to)
{
  const auto inside = [&] (Index p) {
    const Eigen::Vector3d& at = grid.positions[p];
    return at.x () > from && at.x () < to && at.y () > from && at.y () < to;
  };
  Lists rows = unflatten (grid.stars.neighbors);
  for (Index p = 0; p < rows.size (); ++p)
    rows[p].erase (std::remove_if (rows[p].begin (), rows[p].end (),
                                   [&] (Index q) { return inside (p) != inside (q); }),
                   rows[p].end ());
  return rows;
}

TEST (Reachability, OfASheetIsComplete)
{
  const TriangulatedGrid grid (20, 0.1, 1);
  const Reachability reach =
      reachLoop (grid.stars.neighbors, grid.stars.neighbors, grid.positions, grid.loop, 1);
  EXPECT_EQ (reach.reachable, std::vector<std::uint8_t> (grid.positions.size (), 1));
  EXPECT_TRUE (reach.links.empty ());
  EXPECT_EQ (reach.linked_points, 0u);
}

TEST (Reachability, FollowsArcsInTheirDirection)
{
  // Point 1 has the loop, point 0, in its row. Point 0 has 2 in its row, which does not help 2.
  const Lists rows{{2}, {0}, {3}, {2}};
  const Lists none (4);
  const Reachability reach = reachLoop (flatten (rows), flatten (none), line (4), {0}, 1);
  EXPECT_EQ (reach.reachable, (std::vector<std::uint8_t>{1, 1, 0, 0}));
  EXPECT_TRUE (reach.links.empty ());
}

TEST (Reachability, MatchesItsDefinitionOnRandomGraphs)
{
  RandomStream random (2);
  for (int round = 0; round < 50; ++round) {
    const std::size_t count = 5 + random.below (60);
    Lists rows (count);
    for (auto& row : rows)
      for (std::size_t i = random.below (3); i > 0; --i)
        row.push_back (static_cast<Index> (random.below (count)));
    const Reachability reach =
        reachLoop (flatten (rows), flatten (Lists (count)), line (count), {0, 1}, 1);
    EXPECT_EQ (reach.reachable, reachableByDefinition (rows, {0, 1}));
  }
}

TEST (Reachability, LinksTheWholeEdgeOfAnUnconnectedPart)
{
  const TriangulatedGrid grid (21, 0.1, 3);
  const Lists rows = cutOut (grid, 0.28, 0.72); // 9 x 9 points
  const Reachability reach =
      reachLoop (flatten (rows), grid.stars.neighbors, grid.positions, grid.loop, 1);
  EXPECT_EQ (reach.reachable, std::vector<std::uint8_t> (grid.positions.size (), 1));
  EXPECT_EQ (reachableWithLinks (rows, reach.links, grid.loop), reach.reachable);
  EXPECT_EQ (reach.linked_points, 32u);
  EXPECT_TRUE (std::is_sorted (reach.links.begin (), reach.links.end ()));
  const std::vector<std::uint8_t> before = reachableByDefinition (rows, grid.loop);
  for (const auto& link : reach.links) {
    EXPECT_EQ (before[link[0]], 0);
    EXPECT_EQ (before[link[1]], 1);
  }
}

TEST (Reachability, LinksToTheNearest)
{
  // Point 4 has no neighbours. The loop is points 0 to 3, of which 3 is the nearest.
  const Lists rows (5), nearest{{}, {}, {}, {}, {0, 2, 1, 3}};
  const Reachability reach =
      reachLoop (flatten (rows), flatten (nearest), line (5), {0, 1, 2, 3}, 1);
  EXPECT_EQ (reach.links, (Links{{4, 1}, {4, 2}, {4, 3}}));
  EXPECT_EQ (reach.linked_points, 1u);
}

TEST (Reachability, GivesAsManyLinksAsTheLimitsTell)
{
  const Lists rows (5), nearest{{}, {}, {}, {}, {0, 2, 1, 3}};
  DiscLimits limits;
  limits.links_per_point = 2;
  const Reachability reach =
      reachLoop (flatten (rows), flatten (nearest), line (5), {0, 1, 2, 3}, 1, limits);
  EXPECT_EQ (reach.links, (Links{{4, 2}, {4, 3}}));
}

TEST (Reachability, ReadsNearestNeighborsInBothDirections)
{
  // Point 2 has no nearest neighbours, but it is one of 0 and 1. Each gives one link, also if both
  // list each other.
  const Lists rows (3), nearest{{2}, {2}, {}};
  const Reachability reach = reachLoop (flatten (rows), flatten (nearest), line (3), {0, 1}, 1);
  EXPECT_EQ (reach.links, (Links{{2, 0}, {2, 1}}));
  const Lists mutual{{2}, {2}, {0, 1}};
  EXPECT_EQ (reachLoop (flatten (rows), flatten (mutual), line (3), {0, 1}, 1).links, reach.links);
}

TEST (Reachability, ContinuesFromLinkedPoints)
{
  // A chain of points without neighbours, of which each is near the one before, and point 5, which
  // has 4 in its row.
  const Lists rows{{}, {}, {}, {}, {}, {4}}, nearest{{}, {0}, {1}, {2}, {3}, {}};
  const Reachability reach = reachLoop (flatten (rows), flatten (nearest), line (6), {0}, 1);
  EXPECT_EQ (reach.reachable, std::vector<std::uint8_t> (6, 1));
  EXPECT_EQ (reach.links, (Links{{1, 0}, {2, 1}, {3, 2}, {4, 3}}));
  EXPECT_EQ (reach.linked_points, 4u);
}

TEST (Reachability, LeavesOtherComponentsAlone)
{
  const Lists rows{{}, {0}, {3}, {2}}, nearest{{1}, {0}, {3}, {2}};
  const Reachability reach = reachLoop (flatten (rows), flatten (nearest), line (4), {0}, 1);
  EXPECT_EQ (reach.reachable, (std::vector<std::uint8_t>{1, 1, 0, 0}));
  EXPECT_TRUE (reach.links.empty ());
  EXPECT_EQ (reach.linked_points, 0u);
}

TEST (Reachability, DoesNotDependOnTheNumberingOfPoints)
{
  const TriangulatedGrid grid (15, 0.1, 4);
  const Lists rows = cutOut (grid, 0.25, 0.75);
  const Reachability reach =
      reachLoop (flatten (rows), grid.stars.neighbors, grid.positions, grid.loop, 1);
  ASSERT_FALSE (reach.links.empty ());

  const std::size_t count = rows.size ();
  std::vector<Index> renamed (count); // old to new
  std::iota (renamed.begin (), renamed.end (), Index{0});
  RandomStream random (5);
  for (std::size_t i = count; i > 1; --i)
    std::swap (renamed[i - 1], renamed[random.below (i)]);
  Lists new_rows (count), new_nearest (count);
  std::vector<Eigen::Vector3d> positions (count);
  for (std::size_t p = 0; p < count; ++p) {
    for (const Index q : rows[p])
      new_rows[renamed[p]].push_back (renamed[q]);
    for (const Index q : grid.stars.neighbors.row (p))
      new_nearest[renamed[p]].push_back (renamed[q]);
    positions[renamed[p]] = grid.positions[p];
  }
  std::vector<Index> loop;
  for (const Index p : grid.loop)
    loop.insert (loop.begin (), renamed[p]);
  Links expected;
  for (const auto& link : reach.links)
    expected.push_back ({renamed[link[0]], renamed[link[1]]});
  std::sort (expected.begin (), expected.end ());
  EXPECT_EQ (reachLoop (flatten (new_rows), flatten (new_nearest), positions, loop, 1).links,
             expected);
}

TEST (Reachability, OfNothingIsEmpty)
{
  const Reachability reach = reachLoop ({}, {}, {}, {}, 1);
  EXPECT_TRUE (reach.reachable.empty ());
  EXPECT_TRUE (reach.links.empty ());
}

} // namespace
} // namespace pcl::floater
