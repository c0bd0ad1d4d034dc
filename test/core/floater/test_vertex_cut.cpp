// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/vertex_cut.h"

#include "random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace pcl::floater {
namespace {
using Edges = std::set<std::pair<Index, Index>>; // each in both directions

CsrLists
graphOf (Index count, const Edges& edges)
{
  CsrLists graph;
  graph.offsets.push_back (0);
  for (Index v = 0; v < count; ++v) {
    for (const auto& [from, to] : edges)
      if (from == v)
        graph.ids.push_back (to);
    graph.offsets.push_back (static_cast<Index> (graph.ids.size ()));
  }
  return graph;
}

Edges
randomEdges (Index count, std::size_t pairs, RandomStream& random)
{
  Edges edges;
  for (std::size_t i = 0; i < pairs; ++i) {
    const auto a = static_cast<Index> (random.below (count));
    const auto b = static_cast<Index> (random.below (count));
    if (a == b)
      continue;
    edges.insert ({a, b});
    edges.insert ({b, a});
  }
  return edges;
}

// True if no path leads from the first side to the second one without the vertices removed.
bool
separates (const CsrLists& graph, const std::vector<std::uint8_t>& ends,
           const std::vector<bool>& removed)
{
  std::vector<bool> reached (graph.rows (), false);
  std::vector<Index> queue;
  for (Index v = 0; v < graph.rows (); ++v)
    if (!removed[v] && (ends[v] & NEXT_TO_FIRST) != 0) {
      reached[v] = true;
      queue.push_back (v);
    }
  for (std::size_t head = 0; head < queue.size (); ++head) {
    if ((ends[queue[head]] & NEXT_TO_SECOND) != 0)
      return false;
    for (const Index w : graph.row (queue[head]))
      if (!removed[w] && !reached[w]) {
        reached[w] = true;
        queue.push_back (w);
      }
  }
  return true;
}

// The size of the smallest cut, found by trying all sets of vertices.
int
smallestCut (const CsrLists& graph, const std::vector<std::uint8_t>& ends)
{
  const std::size_t count = graph.rows ();
  int smallest = static_cast<int> (count);
  std::vector<bool> removed (count);
  for (std::size_t set = 0; set < std::size_t{1} << count; ++set) {
    for (std::size_t v = 0; v < count; ++v)
      removed[v] = (set >> v & 1) != 0;
    const auto size = static_cast<int> (std::count (removed.begin (), removed.end (), true));
    if (size < smallest && separates (graph, ends, removed))
      smallest = size;
  }
  return smallest;
}

TEST (VertexCut, IsTheSmallestInRandomGraphs)
{
  RandomStream random (7001);
  VertexCut cut;
  for (int trial = 0; trial < 300; ++trial) {
    const auto count = static_cast<Index> (1 + random.below (9));
    const CsrLists graph = graphOf (count, randomEdges (count, random.below (20), random));
    std::vector<std::uint8_t> ends (count);
    for (std::uint8_t& end : ends)
      end = random.below (2) == 0 ? std::uint8_t{0} : static_cast<std::uint8_t> (random.below (4));
    const std::vector<CutPart>& parts = cut.find (graph, ends);
    ASSERT_EQ (parts.size (), count);
    std::vector<bool> removed (count);
    for (Index v = 0; v < count; ++v)
      removed[v] = parts[v] == CutPart::CUT;
    EXPECT_TRUE (separates (graph, ends, removed)) << "trial " << trial;
    EXPECT_EQ (std::count (removed.begin (), removed.end (), true), smallestCut (graph, ends))
        << "trial " << trial;
    for (Index v = 0; v < count; ++v) {
      if (removed[v])
        continue;
      EXPECT_FALSE (parts[v] == CutPart::SECOND && (ends[v] & NEXT_TO_FIRST) != 0);
      EXPECT_FALSE (parts[v] == CutPart::FIRST && (ends[v] & NEXT_TO_SECOND) != 0);
      for (const Index w : graph.row (v))
        EXPECT_TRUE (removed[w] || parts[v] == parts[w]) << "trial " << trial;
    }
  }
}

// Two halls of 20 by 20 vertices with a door of 3 between them. Paths of the first round block the
// door unless later paths can reroute them.
TEST (VertexCut, FindsTheDoor)
{
  constexpr Index SIDE = 20, WIDTH = 2 * SIDE + 1;
  const auto open = [] (Index x, Index y) { return x != SIDE || (y >= 4 && y < 7); };
  const auto at = [] (Index x, Index y) { return y * WIDTH + x; };
  Edges edges;
  for (Index y = 0; y < SIDE; ++y)
    for (Index x = 0; x < WIDTH; ++x)
      for (const auto& [dx, dy] : {std::pair<Index, Index>{1, 0}, {0, 1}, {1, 1}})
        if (x + dx < WIDTH && y + dy < SIDE && open (x, y) && open (x + dx, y + dy)) {
          edges.insert ({at (x, y), at (x + dx, y + dy)});
          edges.insert ({at (x + dx, y + dy), at (x, y)});
        }
  std::vector<std::uint8_t> ends (WIDTH * SIDE, INSIDE);
  for (Index y = 0; y < SIDE; ++y) {
    ends[at (0, y)] = NEXT_TO_FIRST;
    ends[at (WIDTH - 1, y)] = NEXT_TO_SECOND;
  }
  const std::vector<CutPart> parts = VertexCut ().find (graphOf (WIDTH * SIDE, edges), ends);
  EXPECT_EQ (std::count (parts.begin (), parts.end (), CutPart::CUT), 3);
  for (Index y = 0; y < SIDE; ++y) {
    EXPECT_EQ (parts[at (0, y)], CutPart::FIRST);
    EXPECT_EQ (parts[at (WIDTH - 1, y)], CutPart::SECOND);
  }
}

TEST (VertexCut, WithoutSides)
{
  VertexCut cut;
  EXPECT_TRUE (cut.find (graphOf (0, {}), {}).empty ());
  const CsrLists pair = graphOf (2, {{0, 1}, {1, 0}});
  using Parts = std::vector<CutPart>;
  EXPECT_EQ (cut.find (pair, {INSIDE, INSIDE}), Parts (2, CutPart::SECOND));
  EXPECT_EQ (cut.find (pair, {NEXT_TO_FIRST, INSIDE}), Parts (2, CutPart::FIRST));
  EXPECT_EQ (cut.find (pair, {INSIDE, NEXT_TO_SECOND}), Parts (2, CutPart::SECOND));
  EXPECT_EQ (cut.find (pair, {NEXT_TO_FIRST | NEXT_TO_SECOND, INSIDE}),
             (Parts{CutPart::CUT, CutPart::SECOND}));
  EXPECT_EQ (cut.find (pair, {NEXT_TO_FIRST, NEXT_TO_SECOND}),
             (Parts{CutPart::CUT, CutPart::SECOND}));
}

} // namespace
} // namespace pcl::floater
