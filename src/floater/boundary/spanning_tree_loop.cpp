// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/spanning_tree_loop.h"

#include "core/disjoint_sets.h"
#include "floater/boundary/gaps.h"
#include "floater/boundary/loop_refinement.h"
#include "points/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double ALPHAS[] = {1.5, 2.0, 2.5};
constexpr double LARGEST_STEP = 6.0;  // spacings: longer edges are not tried
constexpr double ACCEPTED_STEP = 4.0; // spacings: a loop without a longer edge is trusted
constexpr std::size_t NEAR_CANDIDATES = 8;
constexpr double MUTUAL_COST = 0.05; // relative to an edge between candidates that are merely near
constexpr double ONE_SIDED_COST = 0.4;

struct CandidateEdge
{
  Index a, b; // candidates, a < b
  float length;
  float cost;
};

// Numbers the points that have a gap.
struct Candidates
{
  std::vector<Index> points; // ascending
  std::vector<Index> of_point;

  Candidates (const std::vector<Gap>& gaps, std::size_t n) : of_point (n, NONE)
  {
    for (const Gap& gap : gaps)
      if (of_point[gap.point] == NONE) {
        of_point[gap.point] = static_cast<Index> (points.size ());
        points.push_back (gap.point);
      }
  }
};

std::vector<CandidateEdge>
joinCandidates (const std::vector<Eigen::Vector3d>& positions, const std::vector<float>& spacing,
                const std::vector<Gap>& gaps, const Candidates& candidates)
{
  std::vector<CandidateEdge> edges;
  const auto add = [&] (Index p, Index q, double relative_cost) {
    const Index a = candidates.of_point[p];
    const Index b = candidates.of_point[q];
    const double length = (positions[p] - positions[q]).norm ();
    if (a == b || a == NONE || b == NONE || length > LARGEST_STEP * 0.5 * (spacing[p] + spacing[q]))
      return;
    edges.push_back ({std::min (a, b), std::max (a, b), static_cast<float> (length),
                      static_cast<float> (relative_cost * length)});
  };
  const auto sees = [&] (Index p, Index q) { // gaps are ordered by point
    const auto first =
        std::lower_bound (gaps.begin (), gaps.end (), p,
                          [] (const Gap& gap, Index point) { return gap.point < point; });
    for (auto gap = first; gap != gaps.end () && gap->point == p; ++gap)
      if (gap->first == q || gap->last == q)
        return true;
    return false;
  };
  for (const Gap& gap : gaps)
    for (const Index q : {gap.first, gap.last})
      add (gap.point, q, sees (q, gap.point) ? MUTUAL_COST : ONE_SIDED_COST);

  std::vector<Eigen::Vector3d> places;
  places.reserve (candidates.points.size ());
  for (Index p : candidates.points)
    places.push_back (positions[p]);
  const KdTree tree (places, 1);
  std::vector<Neighbor> found;
  for (Index p : candidates.points) {
    tree.nearest (positions[p], NEAR_CANDIDATES + 1, found);
    for (const Neighbor& neighbor : found)
      add (p, candidates.points[neighbor.point], 1.0);
  }

  // The cheapest of equal edges first; then by cost, ties by candidates.
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
  return edges;
}

// Minimum spanning forest with ancestors, for lengths of tree paths.
class SpanningForest
{
public:
  // Kruskal's algorithm; `edges` by cost. Edges left outside the forest are moved to `outside`.
  SpanningForest (std::size_t nodes, const std::vector<CandidateEdge>& edges,
                  std::vector<CandidateEdge>& outside)
      : root_distance_ (nodes, 0.0), depth_ (nodes, 0), tree_ (nodes, NONE)
  {
    DisjointSets trees (nodes);
    std::vector<std::vector<std::pair<Index, float>>> adjacent (nodes);
    for (const CandidateEdge& edge : edges) {
      if (!trees.join (edge.a, edge.b)) {
        outside.push_back (edge);
        continue;
      }
      adjacent[edge.a].emplace_back (edge.b, edge.length);
      adjacent[edge.b].emplace_back (edge.a, edge.length);
    }
    ancestors_.emplace_back (nodes, NONE);
    std::vector<Index> stack;
    for (Index root = 0; root < nodes; ++root) {
      if (tree_[root] != NONE)
        continue;
      tree_[root] = root;
      ancestors_[0][root] = root;
      stack.push_back (root);
      while (!stack.empty ()) {
        const Index x = stack.back ();
        stack.pop_back ();
        for (const auto& [y, length] : adjacent[x]) {
          if (tree_[y] != NONE)
            continue;
          tree_[y] = root;
          ancestors_[0][y] = x;
          depth_[y] = depth_[x] + 1;
          root_distance_[y] = root_distance_[x] + length;
          stack.push_back (y);
        }
      }
    }
    const Index deepest = nodes == 0 ? 0 : *std::max_element (depth_.begin (), depth_.end ());
    for (Index step = 1; step <= deepest; step *= 2) {
      const std::vector<Index>& half = ancestors_.back ();
      std::vector<Index> whole (nodes);
      for (Index x = 0; x < nodes; ++x)
        whole[x] = half[half[x]];
      ancestors_.push_back (std::move (whole));
    }
  }

  double pathLength (Index a, Index b) const
  {
    return root_distance_[a] + root_distance_[b] - 2.0 * root_distance_[meeting (a, b)];
  }

  // Nodes of the path from a to b, both included.
  std::vector<Index> path (Index a, Index b) const
  {
    const Index top = meeting (a, b);
    std::vector<Index> up, down;
    for (Index x = a; x != top; x = ancestors_[0][x])
      up.push_back (x);
    for (Index x = b; x != top; x = ancestors_[0][x])
      down.push_back (x);
    up.push_back (top);
    up.insert (up.end (), down.rbegin (), down.rend ());
    return up;
  }

private:
  Index meeting (Index a, Index b) const
  {
    if (depth_[a] < depth_[b])
      std::swap (a, b);
    for (std::size_t level = ancestors_.size (); level-- > 0;)
      if (depth_[a] - depth_[b] >= (Index{1} << level))
        a = ancestors_[level][a];
    for (std::size_t level = ancestors_.size (); level-- > 0 && a != b;)
      if (ancestors_[level][a] != ancestors_[level][b]) {
        a = ancestors_[level][a];
        b = ancestors_[level][b];
      }
    return a == b ? a : ancestors_[0][a];
  }

  std::vector<std::vector<Index>> ancestors_; // level l: 2^l steps up
  std::vector<double> root_distance_;
  std::vector<Index> depth_, tree_;
};

void
measure (LongestLoop& loop, const std::vector<Eigen::Vector3d>& positions,
         const std::vector<float>& spacing)
{
  loop.length = 0.0;
  loop.largest_step = 0.0;
  for (std::size_t i = 0; i < loop.points.size (); ++i) {
    const Index p = loop.points[i];
    const Index q = loop.points[(i + 1) % loop.points.size ()];
    const double step = (positions[p] - positions[q]).norm ();
    loop.length += step;
    loop.largest_step = std::max (loop.largest_step, step / (0.5 * (spacing[p] + spacing[q])));
  }
}

LongestLoop
loopForAlpha (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
              const std::vector<float>& spacing, double alpha)
{
  LongestLoop loop;
  const std::vector<Gap> gaps = findGaps (stars, spacing, alpha);
  const Candidates candidates (gaps, positions.size ());
  loop.candidates = candidates.points.size ();
  std::vector<CandidateEdge> outside;
  const SpanningForest forest (candidates.points.size (),
                               joinCandidates (positions, spacing, gaps, candidates), outside);
  const CandidateEdge* closing = nullptr;
  double longest = 0.0;
  for (const CandidateEdge& edge : outside) {
    const double length = forest.pathLength (edge.a, edge.b) + edge.length;
    if (length > longest * (1.0 + 1e-9)) {
      longest = length;
      closing = &edge;
    }
  }
  if (closing == nullptr)
    return loop;
  for (Index candidate : forest.path (closing->a, closing->b))
    loop.points.push_back (candidates.points[candidate]);
  if (loop.points.size () < 3) {
    loop.points.clear ();
    return loop;
  }
  refineLoop (positions, stars, spacing, candidates.points, loop.points);
  measure (loop, positions, spacing);
  return loop;
}

} // namespace

LongestLoop
spanningTreeLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                  const std::vector<float>& spacing)
{
  LongestLoop best;
  for (const double alpha : ALPHAS) {
    LongestLoop loop = loopForAlpha (positions, stars, spacing, alpha);
    if (loop.points.empty () && !best.points.empty ())
      continue;
    const bool trusted = loop.largest_step <= ACCEPTED_STEP;
    const bool best_trusted = best.largest_step <= ACCEPTED_STEP;
    if (best.points.empty () || (trusted && !best_trusted) ||
        (trusted == best_trusted && loop.length > 1.02 * best.length))
      best = std::move (loop);
  }
  return best;
}

} // namespace floater
} // namespace pcl
