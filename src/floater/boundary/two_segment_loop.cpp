// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/two_segment_loop.h"

#include "core/csr_lists.h"
#include "floater/boundary/neighbor_graph.h"
#include "points/kd_tree.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

namespace pcl::floater {
namespace {
using Positions = std::vector<Eigen::Vector3d>;

// Appends points to a segment that begins with `seed` until it has `size` points.
//
// The first_k nearest neighbours of the points in the segment come first. A farther neighbour is
// appended only if these are exhausted. TW 385 leaves open which of several candidates of one rank
// comes first. Here it is the nearest to the seed along the segment: both ends then advance alike,
// and the last point appended is an end.
std::vector<Index>
growSegment (const Positions& points, Index seed, std::size_t size, const RunContext& run,
             const LoopLimits& limits)
{
  const std::vector<NeighborEdge> edges = neighborGraph (points, limits.largest_k, run);
  const CsrLists edges_of_point = makeCsrLists (points.size (), [&edges] (const auto& emit) {
    for (Index e = 0; e < edges.size (); ++e) {
      emit (edges[e].a, e);
      emit (edges[e].b, e);
    }
  });

  // Rank, length of the path from the seed, point.
  using Candidate = std::tuple<Index, double, Index>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
  std::vector<std::uint8_t> appended (points.size (), 0);
  std::vector<Index> segment;
  candidates.emplace (0, 0.0, seed);
  ProgressLoop progress (run, size);
  while (segment.size () < size && !candidates.empty ()) {
    const auto [rank, path, p] = candidates.top ();
    candidates.pop ();
    if (appended[p])
      continue;
    appended[p] = 1;
    segment.push_back (p);
    progress.next ();
    for (const Index e : edges_of_point.row (p)) {
      const NeighborEdge& edge = edges[e];
      const Index q = edge.a == p ? edge.b : edge.a;
      if (!appended[q])
        candidates.emplace (std::max (edge.rank, limits.first_k - 1), path + edge.length, q);
    }
  }
  return segment;
}

// The univariate Floater parameterization: t = 0 at the first point, t = 1 at the last one, and
// every other point is a convex combination of its neighbours with weights proportional to
// 1 / distance. Each row is multiplied by its sum of 1 / distance. The matrix is then symmetric,
// and positive definite since the graph is connected.
// \return points ascending in t; empty if two points coincide or the system is singular
std::vector<Index>
univariateOrder (const std::vector<NeighborEdge>& graph, Index size)
{
  const Index last = size - 1;
  const Eigen::Index unknowns = static_cast<Eigen::Index> (size) - 2;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero (unknowns);
  const auto combine = [&] (Index p, Index q, double weight) {
    if (p == 0 || p == last)
      return;
    entries.emplace_back (p - 1, p - 1, weight);
    if (q == last)
      rhs[p - 1] += weight;
    else if (q != 0)
      entries.emplace_back (p - 1, q - 1, -weight);
  };
  for (const NeighborEdge& edge : graph) {
    if (!(edge.length > 0.0))
      return {};
    combine (edge.a, edge.b, 1.0 / edge.length);
    combine (edge.b, edge.a, 1.0 / edge.length);
  }
  Eigen::SparseMatrix<double> matrix (unknowns, unknowns);
  matrix.setFromTriplets (entries.begin (), entries.end ());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver (matrix);
  if (solver.info () != Eigen::Success)
    return {};
  const Eigen::VectorXd t = solver.solve (rhs);
  if (!t.allFinite ())
    return {};

  std::vector<Index> order (size);
  std::iota (order.begin (), order.end (), Index{0});
  std::stable_sort (order.begin () + 1, order.end () - 1,
                    [&t] (Index p, Index q) { return t[p - 1] < t[q - 1]; });
  return order;
}

// Orders a segment between its ends, its first and its last point. The best number of neighbours
// depends on the jags of the border: with too few, several points get the same parameter; with too
// many, jags are smoothed out. Both make the path through the points longer, so the shortest order
// is used.
std::vector<Index>
orderSegment (const Positions& positions, const std::vector<Index>& segment, const RunContext& run,
              const LoopLimits& limits)
{
  Positions points;
  points.reserve (segment.size ());
  for (const Index p : segment)
    points.push_back (positions[p]);
  const std::vector<NeighborEdge> graph = neighborGraph (points, limits.largest_k, run);
  const Index size = static_cast<Index> (points.size ());
  std::vector<Index> shortest;
  double shortest_length = std::numeric_limits<double>::infinity ();
  for (const Index k : limits.univariate_k) {
    run.poll ();
    std::vector<Index> order = univariateOrder (nearestPart (graph, size, k), size);
    if (order.empty ())
      return {};
    double length = 0.0;
    for (std::size_t i = 1; i < order.size (); ++i)
      length += (points[order[i]] - points[order[i - 1]]).norm ();
    if (length < shortest_length) {
      shortest_length = length;
      shortest = std::move (order);
    }
  }
  for (Index& p : shortest)
    p = segment[p];
  return shortest;
}

} // namespace

std::vector<Index>
twoSegmentLoop (const Positions& positions, const std::vector<Index>& cluster,
                const RunContext& run, const LoopLimits& limits)
{
  if (cluster.size () < 4)
    return {};
  Positions points;
  points.reserve (cluster.size ());
  for (const Index p : cluster)
    points.push_back (positions[p]);

  std::vector<Index> segment1 = growSegment (points, 0, points.size () / 2 + 1, run, limits);

  // Segment 2 begins at the end of segment 1 and takes all other points.
  std::vector<std::uint8_t> in_segment1 (points.size (), 0);
  for (const Index p : segment1)
    in_segment1[p] = 1;
  std::vector<Index> segment2{segment1.back ()};
  for (Index p = 0; p < points.size (); ++p)
    if (!in_segment1[p])
      segment2.push_back (p);
  Positions points2;
  points2.reserve (segment2.size ());
  for (const Index p : segment2)
    points2.push_back (points[p]);
  const Index segment2_last = growSegment (points2, 0, points2.size (), run, limits).back ();
  std::swap (segment2[segment2_last], segment2.back ());

  // The end of segment 2 is the start of segment 1.
  segment1.insert (segment1.begin (), segment2.back ());
  std::vector<Index> loop = orderSegment (points, segment1, run, limits);
  const std::vector<Index> way_back = orderSegment (points, segment2, run, limits);
  if (loop.empty () || way_back.empty ())
    return {};
  loop.insert (loop.end (), way_back.begin () + 1, way_back.end () - 1);
  for (Index& p : loop)
    p = cluster[p];
  return loop;
}

namespace {
// Largest number of steps along the loop between two edges that 2-opt exchanges. A longer reversal
// does not undo a crossing of neighbouring jags, and the time grows with the window.
constexpr std::size_t WINDOW = 30;
constexpr int UNTANGLE_PASSES = 10; // each only if the last one changed something
constexpr int INSERTION_PASSES = 4; // a candidate may lie beyond an edge to one just inserted
// Nearest points of the loop whose edges are tried for a candidate.
constexpr std::size_t TRIED_LOOP_POINTS = 4;

double
distance (const std::vector<Eigen::Vector3d>& positions, Index p, Index q)
{
  return (positions[p] - positions[q]).norm ();
}

// 2-opt: reverses stretches of the loop while that shortens it.
void
untangle (const std::vector<Eigen::Vector3d>& positions, std::vector<Index>& loop,
          const RunContext& run)
{
  ProgressLoop progress (run);
  const std::size_t n = loop.size ();
  const std::size_t window = std::min (WINDOW, n - 2);
  const auto at = [&] (std::size_t i) -> Index& { return loop[i % n]; };
  bool changed = n > 4;
  for (int pass = 0; changed && pass < UNTANGLE_PASSES; ++pass) {
    changed = false;
    for (std::size_t i = 0; i < n; ++i) {
      progress.next ();
      for (std::size_t j = i + 2; j <= i + window; ++j) {
        // Edges (i, i + 1) and (j, j + 1) become (i, j) and (i + 1, j + 1).
        if ((j + 1) % n == i)
          continue;
        const double now =
            distance (positions, at (i), at (i + 1)) + distance (positions, at (j), at (j + 1));
        const double then =
            distance (positions, at (i), at (j)) + distance (positions, at (i + 1), at (j + 1));
        if (then < now * (1.0 - 1e-9)) {
          for (std::size_t a = i + 1, b = j; a < b; ++a, --b)
            std::swap (at (a), at (b));
          changed = true;
        }
      }
    }
  }
}

// Determines the side of the surface at the loop. The normals of the loop's points are oriented one
// after the other. Then the edges vote whether the neighbours of their points lie to the left or to
// the right.
class LoopSides
{
public:
  LoopSides (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
             const std::vector<Index>& loop)
      : positions_ (positions)
  {
    Eigen::Vector3d previous = stars.normals[loop.front ()].cast<double> ();
    double vote = 0.0;
    normals_.reserve (loop.size ());
    for (std::size_t i = 0; i < loop.size (); ++i) {
      Eigen::Vector3d normal = stars.normals[loop[i]].cast<double> ();
      if (normal.dot (previous) < 0.0)
        normal = -normal;
      normals_.push_back (normal);
      previous = normal;
      const Index a = loop[i], b = loop[(i + 1) % loop.size ()];
      const Eigen::Vector3d left = normal.cross (positions[b] - positions[a]).normalized ();
      for (Index q : stars.neighbors.row (a)) {
        const Eigen::Vector3d offset = positions[q] - positions[a];
        vote += left.dot (offset) / offset.norm ();
      }
    }
    if (vote < 0.0)
      for (Eigen::Vector3d& normal : normals_)
        normal = -normal;
  }

  // Distance of c from the line through a and b, positive on the surface's side. `at` is the index
  // of a in the loop.
  double inside (std::size_t at, Index a, Index b, Index c) const
  {
    return normals_[at]
        .cross (positions_[b] - positions_[a])
        .normalized ()
        .dot (positions_[c] - positions_[a]);
  }

private:
  const std::vector<Eigen::Vector3d>& positions_;
  std::vector<Eigen::Vector3d> normals_;
};

// Inserts candidates that lie on or beyond an edge of the loop.
// \return number of insertions
std::size_t
insertBeyond (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
              const std::vector<float>& spacing, const std::vector<Index>& candidates,
              std::vector<Index>& loop, const RunContext& run, const LoopLimits& limits)
{
  const LoopSides sides (positions, stars, loop);
  std::vector<std::uint8_t> on_loop (positions.size (), 0);
  std::vector<Eigen::Vector3d> places;
  for (Index p : loop) {
    on_loop[p] = 1;
    places.push_back (positions[p]);
  }
  const KdTree tree (places, run);
  struct Insertion
  {
    std::size_t after; // index in the loop
    double along;      // position along the edge: several points may go to one edge
    Index point;
  };
  std::vector<Insertion> insertions;
  std::vector<Neighbor> found;
  ProgressLoop progress (run);
  for (Index c : candidates) {
    progress.next ();
    if (on_loop[c] != 0)
      continue;
    tree.nearest (positions[c], TRIED_LOOP_POINTS, found);
    double smallest = limits.largest_detour * spacing[c];
    Insertion best{0, 0.0, NONE};
    for (const Neighbor& neighbor : found)
      for (const std::size_t i :
           {std::size_t{neighbor.point}, (neighbor.point + loop.size () - 1) % loop.size ()}) {
        const Index a = loop[i], b = loop[(i + 1) % loop.size ()];
        const double edge = distance (positions, a, b);
        const double detour = distance (positions, a, c) + distance (positions, c, b) - edge;
        if (detour >= smallest)
          continue;
        smallest = detour;
        const bool beyond = sides.inside (i, a, b, c) < limits.edge_margin * edge;
        best = {i, (positions[c] - positions[a]).dot (positions[b] - positions[a]),
                beyond ? c : NONE};
      }
    if (best.point != NONE)
      insertions.push_back (best);
  }
  std::sort (insertions.begin (), insertions.end (), [] (const Insertion& x, const Insertion& y) {
    return std::tie (x.after, x.along, x.point) < std::tie (y.after, y.along, y.point);
  });
  std::vector<Index> wider;
  auto next = insertions.begin ();
  for (std::size_t i = 0; i < loop.size (); ++i) {
    wider.push_back (loop[i]);
    for (; next != insertions.end () && next->after == i; ++next)
      wider.push_back (next->point);
  }
  loop = std::move (wider);
  return insertions.size ();
}

} // namespace

void
refineLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
            const std::vector<float>& spacing, const std::vector<Index>& candidates,
            std::vector<Index>& loop, const RunContext& run, const LoopLimits& limits)
{
  untangle (positions, loop, run);
  for (int pass = 0; pass < INSERTION_PASSES &&
                     insertBeyond (positions, stars, spacing, candidates, loop, run, limits) > 0;
       ++pass)
    untangle (positions, loop, run);
}

} // namespace pcl::floater
