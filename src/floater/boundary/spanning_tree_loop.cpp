// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/disjoint_sets.h"
#include "core/geometry.h"
#include "core/order_statistics.h"
#include "floater/boundary/boundary.h"
#include "points/kd_tree.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace pcl::floater {
namespace {
using Positions = std::vector<Eigen::Vector3d>;

// Nearest candidates that are connected with a candidate, besides those at the ends of its gaps.
constexpr std::size_t NEAR_CANDIDATES = 8;

struct CandidateEdge
{
  Index a, b; // numbers of candidates, a < b
  float length;
  float cost;
};

// The points that have a gap, ascending.
std::vector<Index>
pointsOf (const std::vector<Gap>& gaps)
{
  std::vector<Index> points;
  for (const Gap& gap : gaps)
    if (points.empty () || points.back () != gap.point)
      points.push_back (gap.point);
  return points;
}

// Keeps the cheapest of several edges between the same candidates, and sorts by cost, then by the
// candidates' numbers.
void
sortByCost (std::vector<CandidateEdge>& edges)
{
  std::sort (edges.begin (), edges.end (), [] (const CandidateEdge& x, const CandidateEdge& y) {
    return std::tie (x.a, x.b, x.cost) < std::tie (y.a, y.b, y.cost);
  });
  edges.erase (std::unique (edges.begin (), edges.end (),
                            [] (const CandidateEdge& x, const CandidateEdge& y) {
                              return x.a == y.a && x.b == y.b;
                            }),
               edges.end ());
  std::sort (edges.begin (), edges.end (), [] (const CandidateEdge& x, const CandidateEdge& y) {
    return std::tie (x.cost, x.a, x.b) < std::tie (y.cost, y.a, y.b);
  });
}

// \param gaps ordered by point
// \return edges by cost
std::vector<CandidateEdge>
joinCandidates (const Positions& positions, const std::vector<float>& spacing,
                const std::vector<Gap>& gaps, const std::vector<Index>& candidates,
                const RunContext& run, const LoopLimits& limits)
{
  std::vector<Index> number_of (positions.size (), NONE); // among the candidates
  for (std::size_t i = 0; i < candidates.size (); ++i)
    number_of[candidates[i]] = static_cast<Index> (i);
  std::vector<CandidateEdge> edges;
  const auto add = [&] (Index p, Index q, double cost_per_length) {
    const Index a = number_of[p], b = number_of[q];
    const double length = (positions[p] - positions[q]).norm ();
    if (a == b || a == NONE || b == NONE ||
        length > limits.longest_edge * 0.5 * (spacing[p] + spacing[q]))
      return;
    edges.push_back ({std::min (a, b), std::max (a, b), static_cast<float> (length),
                      static_cast<float> (cost_per_length * length)});
  };
  const auto sees = [&] (Index p, Index q) {
    const auto first =
        std::lower_bound (gaps.begin (), gaps.end (), p,
                          [] (const Gap& gap, Index point) { return gap.point < point; });
    for (auto gap = first; gap != gaps.end () && gap->point == p; ++gap)
      if (gap->first == q || gap->last == q)
        return true;
    return false;
  };
  ProgressLoop progress (run, gaps.size () + candidates.size ());
  for (const Gap& gap : gaps) {
    progress.next ();
    for (const Index q : {gap.first, gap.last})
      add (gap.point, q, sees (q, gap.point) ? limits.mutual_cost : limits.one_sided_cost);
  }

  const KdTree tree (valuesAt (positions, candidates), run);
  std::vector<Neighbor> found;
  for (Index p : candidates) {
    progress.next ();
    tree.nearest (positions[p], NEAR_CANDIDATES + 1, found); // the candidate itself among them
    for (const Neighbor& neighbor : found)
      add (p, candidates[neighbor.point], 1.0);
  }
  sortByCost (edges);
  return edges;
}

// A minimum spanning forest. Every node stores its parent and an ancestor farther up, so the length
// of the path between two nodes takes O(log nodes) (Myers 1983, "An applicative random-access
// stack").
class SpanningForest
{
public:
  // Kruskal's algorithm.
  // \param edges   by cost
  // \param outside gets the edges that are not in the forest
  SpanningForest (std::size_t nodes, const std::vector<CandidateEdge>& edges,
                  std::vector<CandidateEdge>& outside, const RunContext& run)
      : root_distance_ (nodes, 0.0), depth_ (nodes, 0), parent_ (nodes, NONE), jump_ (nodes, NONE)
  {
    DisjointSets trees (nodes);
    std::vector<std::vector<std::pair<Index, float>>> adjacent (nodes); // with lengths
    ProgressLoop progress (run);
    for (const CandidateEdge& edge : edges) {
      progress.next ();
      if (!trees.join (edge.a, edge.b)) {
        outside.push_back (edge);
        continue;
      }
      adjacent[edge.a].emplace_back (edge.b, edge.length);
      adjacent[edge.b].emplace_back (edge.a, edge.length);
    }
    // Parents, depths and distances of each tree.
    std::vector<Index> stack;
    for (Index root = 0; root < nodes; ++root) {
      if (parent_[root] != NONE)
        continue;
      stack.push_back (root);
      parent_[root] = jump_[root] = root;
      while (!stack.empty ()) {
        progress.next ();
        const Index x = stack.back ();
        stack.pop_back ();
        for (const auto& [y, length] : adjacent[x]) {
          if (parent_[y] != NONE)
            continue;
          parent_[y] = x;
          // Two jumps of equal length become one.
          const Index up = jump_[x];
          jump_[y] = depth_[x] - depth_[up] == depth_[up] - depth_[jump_[up]] ? jump_[up] : x;
          depth_[y] = depth_[x] + 1;
          root_distance_[y] = root_distance_[x] + length;
          stack.push_back (y);
        }
      }
    }
  }

  double pathLength (Index a, Index b) const
  {
    return root_distance_[a] + root_distance_[b] -
           2.0 * root_distance_[lowestCommonAncestor (a, b)];
  }

  // The nodes on the path from a to b, both included.
  std::vector<Index> path (Index a, Index b) const
  {
    const Index top = lowestCommonAncestor (a, b);
    std::vector<Index> up, down;
    for (Index x = a; x != top; x = parent_[x])
      up.push_back (x);
    for (Index x = b; x != top; x = parent_[x])
      down.push_back (x);
    up.push_back (top);
    up.insert (up.end (), down.rbegin (), down.rend ());
    return up;
  }

private:
  // The lowest common ancestor of two nodes of one tree.
  Index lowestCommonAncestor (Index a, Index b) const
  {
    if (depth_[a] < depth_[b])
      std::swap (a, b);
    while (depth_[a] > depth_[b])
      a = depth_[jump_[a]] >= depth_[b] ? jump_[a] : parent_[a];
    while (a != b) {
      const std::vector<Index>& up = jump_[a] != jump_[b] ? jump_ : parent_;
      a = up[a];
      b = up[b];
    }
    return a;
  }

  std::vector<double> root_distance_; // along the tree
  std::vector<Index> depth_;          // edges to the root
  std::vector<Index> parent_, jump_;  // of each node; a root's are itself
};

// The longest cycle that an edge outside of the forest closes, as points; empty if there is none.
std::vector<Index>
longestCycle (const SpanningForest& forest, const std::vector<CandidateEdge>& outside,
              const std::vector<Index>& candidates, const RunContext& run)
{
  constexpr double ROUNDING =
      1e-9; // smaller differences of length count as ties; the first edge wins
  const CandidateEdge* closing = nullptr;
  double longest = 0.0;
  ProgressLoop progress (run);
  for (const CandidateEdge& edge : outside) {
    progress.next ();
    const double length = forest.pathLength (edge.a, edge.b) + edge.length;
    if (length > longest * (1.0 + ROUNDING)) {
      longest = length;
      closing = &edge;
    }
  }
  std::vector<Index> cycle;
  if (closing != nullptr)
    for (Index candidate : forest.path (closing->a, closing->b))
      cycle.push_back (candidates[candidate]);
  return cycle.size () < 3 ? std::vector<Index>{} : cycle;
}

Boundary
findLoop (const Positions& positions, const Stars& stars, const std::vector<float>& spacing,
          double circumradius_ratio, const RunContext& run, const LoopLimits& limits)
{
  Boundary boundary;
  const std::vector<Gap> gaps = findGaps (stars, spacing, circumradius_ratio, run);
  const std::vector<Index> candidates = pointsOf (gaps);
  boundary.candidates = candidates.size ();
  std::vector<CandidateEdge> outside;
  const SpanningForest forest (candidates.size (),
                               joinCandidates (positions, spacing, gaps, candidates, run, limits),
                               outside, run);
  boundary.loop = longestCycle (forest, outside, candidates, run);
  if (boundary.loop.empty ())
    return boundary;
  refineLoop (positions, stars, spacing, candidates, boundary.loop, run, limits);
  measureSteps (positions, spacing, boundary);
  return boundary;
}

} // namespace

Boundary
spanningTreeLoop (const Positions& positions, const Stars& stars, const std::vector<float>& spacing,
                  const RunContext& run, const LoopLimits& limits)
{
  Boundary best;
  double best_length = 0.0;
  for (const double ratio : limits.circumradius_ratios) {
    Boundary boundary = findLoop (positions, stars, spacing, ratio, run, limits);
    if (boundary.loop.empty () && !best.loop.empty ())
      continue;
    const double length = perimeter (positions, boundary.loop);
    const bool is_trusted = boundary.largest_step <= limits.largest_trusted_step;
    const bool is_best_trusted = best.largest_step <= limits.largest_trusted_step;
    if (best.loop.empty () || (is_trusted && !is_best_trusted) ||
        (is_trusted == is_best_trusted && length > limits.least_gain * best_length)) {
      best = std::move (boundary);
      best_length = length;
    }
  }
  return best;
}

} // namespace pcl::floater
