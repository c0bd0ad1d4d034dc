// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The connected graph of neighbouring points on which boundary points are ordered.
#include "floater/boundary/neighbor_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <set>

namespace pcl::floater {
namespace {
using Positions = std::vector<Eigen::Vector3d>;
using Pair = std::pair<Index, Index>;

Positions
randomPoints (int count, unsigned seed)
{
  std::mt19937 random (seed);
  std::uniform_real_distribution<double> uniform (0.0, 1.0);
  Positions points;
  for (int i = 0; i < count; ++i)
    points.emplace_back (uniform (random), uniform (random), uniform (random));
  return points;
}

// Dense clumps that are so far apart that no neighbourhood leads from one to another.
Positions
clumps (int count, int points_in_each, unsigned seed)
{
  const Positions centres = randomPoints (count, seed);
  Positions points;
  for (const Eigen::Vector3d& offset : randomPoints (count * points_in_each, seed + 1000))
    points.push_back (centres[points.size () % centres.size ()] + 1e-3 * offset);
  return points;
}

std::map<Pair, Index>
ranks (const std::vector<NeighborEdge>& graph)
{
  std::map<Pair, Index> result;
  for (const NeighborEdge& edge : graph)
    result[{edge.a, edge.b}] = edge.rank;
  return result;
}

// The pairs of k nearest neighbours, found by sorting all distances.
std::map<Pair, Index>
literalRanks (const Positions& points, Index k)
{
  std::map<Pair, Index> result;
  for (Index p = 0; p < points.size (); ++p) {
    std::vector<std::pair<double, Index>> others;
    for (Index q = 0; q < points.size (); ++q)
      if (q != p)
        others.emplace_back ((points[p] - points[q]).squaredNorm (), q);
    std::sort (others.begin (), others.end ());
    for (Index rank = 0; rank < std::min<std::size_t> (k, others.size ()); ++rank) {
      const Pair pair = std::minmax (p, others[rank].second);
      const auto known = result.emplace (pair, rank).first;
      known->second = std::min (known->second, rank);
    }
  }
  return result;
}

// The edges of the minimum spanning tree, found by Prim's algorithm on all pairs.
std::set<Pair>
spanningTree (const Positions& points)
{
  std::set<Pair> tree;
  std::vector<double> distance (points.size (), std::numeric_limits<double>::infinity ());
  std::vector<Index> parent (points.size (), 0);
  std::vector<std::uint8_t> inside (points.size (), 0);
  distance[0] = 0.0;
  for (std::size_t step = 0; step < points.size (); ++step) {
    Index next = NONE;
    for (Index p = 0; p < points.size (); ++p)
      if (!inside[p] && (next == NONE || distance[p] < distance[next]))
        next = p;
    inside[next] = 1;
    if (next != 0)
      tree.insert (std::minmax (next, parent[next]));
    for (Index p = 0; p < points.size (); ++p)
      if ((points[p] - points[next]).norm () < distance[p]) {
        distance[p] = (points[p] - points[next]).norm ();
        parent[p] = next;
      }
  }
  return tree;
}

std::size_t
countComponents (const std::vector<NeighborEdge>& graph, std::size_t size)
{
  std::vector<std::vector<Index>> neighbors (size);
  for (const NeighborEdge& edge : graph) {
    neighbors[edge.a].push_back (edge.b);
    neighbors[edge.b].push_back (edge.a);
  }
  std::vector<std::uint8_t> seen (size, 0);
  std::size_t components = 0;
  for (Index start = 0; start < size; ++start) {
    components += seen[start] ? 0 : 1;
    for (std::vector<Index> stack{start}; !stack.empty ();) {
      const Index p = stack.back ();
      stack.pop_back ();
      if (!seen[p])
        stack.insert (stack.end (), neighbors[p].begin (), neighbors[p].end ());
      seen[p] = 1;
    }
  }
  return components;
}

TEST (NeighborGraph, HasEachNearestPairOnce)
{
  for (const Index k : {4U, 10U}) {
    const Positions points = randomPoints (150, k);
    const std::vector<NeighborEdge> graph = neighborGraph (points, k, 1);
    EXPECT_EQ (ranks (graph), literalRanks (points, k));
    EXPECT_EQ (ranks (graph).size (), graph.size ());
    for (std::size_t e = 0; e < graph.size (); ++e) {
      EXPECT_LT (graph[e].a, graph[e].b);
      EXPECT_DOUBLE_EQ (graph[e].length, (points[graph[e].a] - points[graph[e].b]).norm ());
    }
    for (std::size_t e = 1; e < graph.size (); ++e)
      EXPECT_LT (Pair (graph[e - 1].a, graph[e - 1].b), Pair (graph[e].a, graph[e].b));
  }
}

TEST (NeighborGraph, BreaksTiesByPoint)
{
  Positions points;
  for (int x = 0; x < 9; ++x)
    for (int y = 0; y < 9; ++y)
      points.emplace_back ((x * 4) % 9, (y * 2) % 9, 0.0);
  EXPECT_EQ (ranks (neighborGraph (points, 4, 1)), literalRanks (points, 4));
}

// The edge to the nearest neighbour is always in the tree, and so is every bridge.
TEST (NeighborGraph, WithOneNeighborIsTheMinimumSpanningTree)
{
  for (unsigned seed = 1; seed <= 5; ++seed)
    for (const Positions& points : {randomPoints (200, seed), clumps (20, 10, seed)}) {
      const std::vector<NeighborEdge> graph = neighborGraph (points, 1, 1);
      std::set<Pair> pairs;
      for (const NeighborEdge& edge : graph)
        pairs.emplace (edge.a, edge.b);
      EXPECT_EQ (pairs, spanningTree (points)) << "seed " << seed;
    }
}

TEST (NeighborGraph, BridgesClumpsWhereTheyAreNearest)
{
  const Positions points = clumps (15, 12, 3);
  const std::vector<NeighborEdge> graph = neighborGraph (points, 5, 1);
  EXPECT_EQ (countComponents (graph, points.size ()), 1U);
  std::set<Pair> bridges;
  for (const NeighborEdge& edge : graph)
    if (edge.rank == 5)
      bridges.emplace (edge.a, edge.b);
  std::set<Pair> between_clumps;
  for (const Pair& pair : spanningTree (points))
    if (pair.first % 15 != pair.second % 15)
      between_clumps.insert (pair);
  EXPECT_EQ (bridges, between_clumps);
}

TEST (NeighborGraph, OfFewPoints)
{
  EXPECT_TRUE (neighborGraph ({}, 3, 1).empty ());
  EXPECT_TRUE (neighborGraph ({{1, 2, 3}}, 3, 1).empty ());
  EXPECT_EQ (neighborGraph ({{0, 0, 0}, {1, 0, 0}}, 3, 1).size (), 1U);
  EXPECT_EQ (neighborGraph ({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 3, 1).size (), 6U);
}

TEST (NearestPart, KeepsTheNearestAndStaysConnected)
{
  const Positions points = clumps (10, 20, 9);
  const std::vector<NeighborEdge> graph = neighborGraph (points, 12, 1);
  for (const Index k : {0U, 1U, 2U, 3U, 12U, 13U}) {
    std::vector<NeighborEdge> nearest;
    std::copy_if (graph.begin (), graph.end (), std::back_inserter (nearest),
                  [k] (const NeighborEdge& edge) { return edge.rank < k; });
    const std::vector<NeighborEdge> part = nearestPart (graph, points.size (), k);
    EXPECT_EQ (countComponents (part, points.size ()), 1U);
    EXPECT_EQ (part.size (), nearest.size () + countComponents (nearest, points.size ()) - 1);
    const std::map<Pair, Index> kept = ranks (part);
    for (const NeighborEdge& edge : nearest)
      EXPECT_EQ (kept.count ({edge.a, edge.b}), 1U);
  }
}

} // namespace
} // namespace pcl::floater
