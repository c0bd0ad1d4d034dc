// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/neighbor_graph.h"

#include "core/disjoint_sets.h"
#include "points/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace pcl::floater {
namespace {
// An edge from one component of the graph to another.
struct Bridge
{
  double sqr_length = std::numeric_limits<double>::infinity ();
  Index a = NONE, b = NONE;

  bool operator<(const Bridge& other) const
  {
    return std::tie (sqr_length, a, b) < std::tie (other.sqr_length, other.a, other.b);
  }
};

// Appends bridges until the graph is connected: in each round the shortest bridge from every
// component (Boruvka's algorithm).
void
connect (std::vector<NeighborEdge>& edges, const std::vector<Eigen::Vector3d>& points,
         const KdTree& tree, Index rank, const RunContext& run)
{
  constexpr double ROUNDING = 1.0 + 1e-15; // squaring a square root may round down
  const std::size_t n = points.size ();
  DisjointSets sets (n);
  std::size_t components = n;
  for (const NeighborEdge& edge : edges)
    components -= sets.join (edge.a, edge.b) ? 1 : 0;
  ProgressLoop progress (run);
  while (components > 1) {
    std::vector<Index> labels (n);
    for (Index p = 0; p < n; ++p)
      labels[p] = sets.find (p);
    // In the order of the tree: where the run of points of one component begins.
    std::vector<Index> begin (n, 0);
    for (Index i = 1; i < n; ++i)
      begin[i] = labels[tree.pointAt (i)] == labels[tree.pointAt (i - 1)] ? begin[i - 1] : i;
    std::vector<Bridge> shortest (n); // by the label of the component
    std::vector<Neighbor> found;
    for (Index p = 0; p < n; ++p) {
      progress.next ();
      Bridge& bridge = shortest[labels[p]];
      tree.nearestIf (
          points[p], Eigen::Vector3d::Zero (), ROUNDING * std::sqrt (bridge.sqr_length), 1,
          [&] (const Neighbor& other, const auto&) { return labels[other.point] != labels[p]; },
          found,
          [&] (Index first, Index last) {
            return begin[last - 1] <= first && labels[tree.pointAt (first)] == labels[p];
          });
      for (const auto& [sqr_length, q] : found)
        bridge = std::min (bridge, Bridge{sqr_length, std::min (p, q), std::max (p, q)});
    }
    for (const Bridge& bridge : shortest)
      if (bridge.a != NONE && sets.join (bridge.a, bridge.b)) {
        edges.push_back ({bridge.a, bridge.b, rank, std::sqrt (bridge.sqr_length)});
        --components;
      }
  }
}

} // namespace

std::vector<NeighborEdge>
neighborGraph (const std::vector<Eigen::Vector3d>& points, Index k, const RunContext& run)
{
  const KdTree tree (points, run);
  std::vector<NeighborEdge> edges;
  std::vector<Neighbor> nearest;
  ProgressLoop progress (run, points.size ());
  for (Index p = 0; p < points.size (); ++p) {
    progress.next ();
    tree.nearest (points[p], std::size_t{k} + 1, nearest);
    Index rank = 0;
    for (const Neighbor& neighbor : nearest)
      if (neighbor.point != p && rank < k)
        edges.push_back ({std::min (p, neighbor.point), std::max (p, neighbor.point), rank++,
                          std::sqrt (neighbor.sqr_distance)});
  }
  connect (edges, points, tree, k, run);
  std::sort (edges.begin (), edges.end (), [] (const NeighborEdge& e, const NeighborEdge& f) {
    return std::tie (e.a, e.b, e.rank) < std::tie (f.a, f.b, f.rank);
  });
  const auto same = [] (const NeighborEdge& e, const NeighborEdge& f) {
    return e.a == f.a && e.b == f.b;
  };
  edges.erase (std::unique (edges.begin (), edges.end (), same), edges.end ());
  return edges;
}

std::vector<NeighborEdge>
nearestPart (const std::vector<NeighborEdge>& graph, std::size_t size, Index k)
{
  std::vector<NeighborEdge> part, others;
  DisjointSets sets (size);
  for (const NeighborEdge& edge : graph)
    if (edge.rank < k) {
      sets.join (edge.a, edge.b);
      part.push_back (edge);
    }
    else
      others.push_back (edge);
  // Kruskal's algorithm.
  std::sort (others.begin (), others.end (), [] (const NeighborEdge& e, const NeighborEdge& f) {
    return std::tie (e.length, e.a, e.b) < std::tie (f.length, f.a, f.b);
  });
  for (const NeighborEdge& edge : others)
    if (sets.join (edge.a, edge.b))
      part.push_back (edge);
  return part;
}

namespace {
// Indices of the points in the list, by descending number of points around; ties in the order of
// the list.
std::vector<Index>
byDescendingDensity (const std::vector<Eigen::Vector3d>& points, const KdTree& tree, double radius,
                     const RunContext& run)
{
  ProgressLoop progress (run, points.size ());
  std::vector<std::size_t> density (points.size ());
  for (std::size_t i = 0; i < points.size (); ++i) {
    progress.next ();
    density[i] = tree.count (points[i], radius);
  }
  std::vector<Index> order (points.size ());
  std::iota (order.begin (), order.end (), Index{0});
  std::stable_sort (order.begin (), order.end (),
                    [&density] (Index a, Index b) { return density[a] > density[b]; });
  return order;
}

} // namespace

std::vector<std::vector<Index>>
clusterBoundaryPoints (const std::vector<Eigen::Vector3d>& positions,
                       const std::vector<Index>& boundary_points, double tolerance, int k,
                       const RunContext& run)
{
  std::vector<Eigen::Vector3d> points;
  points.reserve (boundary_points.size ());
  for (const Index p : boundary_points)
    points.push_back (positions[p]);

  const KdTree tree (points, run);
  const std::size_t appended = static_cast<std::size_t> (std::max (k, 0));
  std::vector<std::uint8_t> taken (points.size (), 0);
  std::vector<Neighbor> nearest;
  std::vector<std::vector<Index>> clusters;
  const std::vector<Index> starts = byDescendingDensity (points, tree, tolerance, run);
  ProgressLoop progress (run, points.size ());
  for (const Index start : starts) {
    if (taken[start])
      continue;
    std::vector<Index> cluster{start};
    taken[start] = 1;
    // The order does not matter: a cluster is everything that can be reached from its start among
    // the untaken points.
    for (std::size_t processed = 0; processed < cluster.size (); ++processed) {
      progress.next ();
      const Index p = cluster[processed];
      tree.nearest (points[p], appended + 1, nearest);
      std::size_t rank = 0;
      for (const Neighbor& neighbor : nearest) {
        if (neighbor.point == p)
          continue;
        if (rank++ == appended || neighbor.sqr_distance > tolerance * tolerance)
          break;
        if (!taken[neighbor.point]) {
          taken[neighbor.point] = 1;
          cluster.push_back (neighbor.point);
        }
      }
    }
    for (Index& p : cluster)
      p = boundary_points[p];
    std::sort (cluster.begin (), cluster.end ());
    clusters.push_back (std::move (cluster));
  }
  std::sort (clusters.begin (), clusters.end (),
             [] (const std::vector<Index>& a, const std::vector<Index>& b) {
               return a.size () != b.size () ? a.size () > b.size () : a.front () < b.front ();
             });
  return clusters;
}

} // namespace pcl::floater
