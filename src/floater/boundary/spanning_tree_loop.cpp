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
    edges.push_back (
        {std::min (a, b), std::max (a, b), static_cast<float> (cost_per_length * length)});
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
  std::sort (edges.begin (), edges.end (), [] (const CandidateEdge& x, const CandidateEdge& y) {
    return std::tie (x.cost, x.a, x.b) < std::tie (y.cost, y.a, y.b);
  });
  return edges;
}

// The longest cycle that one edge closes in a minimum spanning forest (Kruskal's algorithm), as
// points; empty if there is none. O(c log c), and the lengths of all these cycles, most of which
// are short.
// \param edges by cost
std::vector<Index>
longestCycle (const Positions& positions, const std::vector<CandidateEdge>& edges,
              const std::vector<Index>& candidates, const RunContext& run)
{
  DisjointSets trees (candidates.size ());
  std::vector<CandidateEdge> outside;
  std::vector<std::vector<Index>> adjacent (candidates.size ());
  for (const CandidateEdge& edge : edges)
    if (trees.join (edge.a, edge.b)) {
      adjacent[edge.a].push_back (edge.b);
      adjacent[edge.b].push_back (edge.a);
    }
    else
      outside.push_back (edge);
  // The root of a tree is its own parent.
  std::vector<Index> parent (candidates.size (), NONE), depth (candidates.size (), 0);
  for (Index root = 0; root < candidates.size (); ++root) {
    if (parent[root] != NONE)
      continue;
    parent[root] = root;
    for (std::vector<Index> stack{root}; !stack.empty ();) {
      const Index x = stack.back ();
      stack.pop_back ();
      for (const Index y : adjacent[x])
        if (parent[y] == NONE) {
          parent[y] = x;
          depth[y] = depth[x] + 1;
          stack.push_back (y);
        }
    }
  }
  constexpr double ROUNDING =
      1e-9; // smaller differences of length count as ties; the first edge wins
  std::vector<Index> longest, cycle, way_back;
  double longest_length = 0.0;
  ProgressLoop progress (run, outside.size ());
  for (auto [a, b, cost] : outside) {
    progress.next ();
    cycle.clear ();
    way_back.clear ();
    while (a != b) {
      Index& lower = depth[a] >= depth[b] ? a : b;
      (&lower == &a ? cycle : way_back).push_back (candidates[lower]);
      lower = parent[lower];
    }
    cycle.push_back (candidates[a]);
    cycle.insert (cycle.end (), way_back.rbegin (), way_back.rend ());
    const double length = perimeter (positions, cycle);
    if (cycle.size () >= 3 && length > longest_length * (1.0 + ROUNDING)) {
      longest_length = length;
      longest = cycle;
    }
  }
  return longest;
}

Boundary
findLoop (const Positions& positions, const Stars& stars, const std::vector<float>& spacing,
          double circumradius_ratio, const RunContext& run, const LoopLimits& limits)
{
  Boundary boundary;
  const std::vector<Gap> gaps = findGaps (stars, spacing, circumradius_ratio, run);
  const std::vector<Index> candidates = pointsOf (gaps);
  boundary.candidates = candidates.size ();
  boundary.loop =
      longestCycle (positions, joinCandidates (positions, spacing, gaps, candidates, run, limits),
                    candidates, run);
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
