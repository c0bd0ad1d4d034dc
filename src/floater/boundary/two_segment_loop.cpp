// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/two_segment_loop.h"

#include "core/csr_lists.h"
#include "floater/boundary/neighbor_graph.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
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

} // namespace pcl::floater
