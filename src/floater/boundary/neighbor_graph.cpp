// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/neighbor_graph.h"

#include "core/disjoint_sets.h"
#include "points/kd_tree.h"

#include <Eigen/Geometry>

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

// A kd-tree that finds the nearest point of another component. Nodes with a single component are
// labelled with it; queries from there skip them.
class ComponentTree
{
public:
  explicit ComponentTree (const std::vector<Eigen::Vector3d>& points)
      : points_ (points), ids_ (points.size ())
  {
    std::iota (ids_.begin (), ids_.end (), Index{0});
    build (0, static_cast<Index> (ids_.size ()));
  }

  void setLabels (std::vector<Index> labels)
  {
    labels_ = std::move (labels);
    for (std::size_t n = nodes_.size (); n-- > 0;) { // children follow their parent
      Node& node = nodes_[n];
      node.label = node.right == NONE ? labels_[ids_[node.first]] : nodes_[n + 1].label;
      const bool uniform = node.right == NONE
                               ? std::all_of (ids_.begin () + node.first, ids_.begin () + node.last,
                                              [&] (Index p) { return labels_[p] == node.label; })
                               : node.label == nodes_[node.right].label;
      if (!uniform)
        node.label = NONE;
    }
  }

  // Replaces `shortest` if there is a shorter bridge from p.
  void shorten (Bridge& shortest, Index p) const { search (0, p, shortest); }

private:
  static constexpr Index LEAF_SIZE = 8;

  struct Node
  {
    Eigen::AlignedBox3d box;
    Index first, last;
    Index right; // the left child is the next node; NONE at a leaf
    Index label; // of the component; NONE if there are several
  };

  void build (Index first, Index last)
  {
    Eigen::AlignedBox3d box;
    for (Index i = first; i < last; ++i)
      box.extend (points_[ids_[i]]);
    const std::size_t self = nodes_.size ();
    nodes_.push_back ({box, first, last, NONE, NONE});
    if (last - first <= LEAF_SIZE)
      return;
    Eigen::Index axis = 0;
    box.sizes ().maxCoeff (&axis);
    const Index middle = first + (last - first) / 2;
    std::nth_element (
        ids_.begin () + first, ids_.begin () + middle, ids_.begin () + last,
        [this, axis] (Index p, Index q) { return points_[p][axis] < points_[q][axis]; });
    build (first, middle);
    nodes_[self].right = static_cast<Index> (nodes_.size ());
    build (middle, last);
  }

  double sqrDistance (Index node, Index p) const
  {
    return nodes_[node].box.squaredExteriorDistance (points_[p]);
  }

  void search (Index n, Index p, Bridge& shortest) const
  {
    const Node& node = nodes_[n];
    if (node.label == labels_[p] || sqrDistance (n, p) > shortest.sqr_length)
      return;
    if (node.right == NONE) {
      for (Index i = node.first; i < node.last; ++i) {
        const Index q = ids_[i];
        if (labels_[q] != labels_[p])
          shortest = std::min (shortest, Bridge{(points_[p] - points_[q]).squaredNorm (),
                                                std::min (p, q), std::max (p, q)});
      }
      return;
    }
    Index near = n + 1;
    Index far = node.right;
    if (sqrDistance (far, p) < sqrDistance (near, p))
      std::swap (near, far);
    search (near, p, shortest);
    search (far, p, shortest);
  }

  const std::vector<Eigen::Vector3d>& points_;
  std::vector<Index> ids_; // in the order of the leaves
  std::vector<Node> nodes_;
  std::vector<Index> labels_;
};

// Appends bridges until the graph is connected: in each round the shortest bridge from every
// component (Boruvka's algorithm).
void
connect (std::vector<NeighborEdge>& edges, const std::vector<Eigen::Vector3d>& points, Index rank,
         const RunContext& run)
{
  DisjointSets sets (points.size ());
  std::size_t components = points.size ();
  for (const NeighborEdge& edge : edges)
    components -= sets.join (edge.a, edge.b) ? 1 : 0;
  if (components < 2)
    return;
  ComponentTree tree (points);
  ProgressLoop progress (run);
  while (components > 1) {
    std::vector<Index> labels (points.size ());
    for (Index p = 0; p < points.size (); ++p)
      labels[p] = sets.find (p);
    tree.setLabels (labels);
    std::vector<Bridge> shortest (points.size ()); // by the label of the component
    for (Index p = 0; p < points.size (); ++p) {
      progress.next ();
      tree.shorten (shortest[labels[p]], p);
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
  connect (edges, points, k, run);
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
// A tree that counts points in spheres. A sphere of the growing distance contains a large piece of
// a dense boundary, so nodes inside of it are counted as a whole.
class SphereCounter
{
public:
  explicit SphereCounter (const std::vector<Eigen::Vector3d>& points) : points_ (points)
  {
    if (!points_.empty ())
      build (0, static_cast<Index> (points_.size ()));
  }

  std::size_t count (const Eigen::Vector3d& centre, double sqr_radius) const
  {
    std::size_t found = 0;
    for (std::size_t n = 0; n < nodes_.size ();) {
      const Node& node = nodes_[n];
      const Eigen::Vector3d below = node.lower - centre;
      const Eigen::Vector3d above = centre - node.upper;
      const Eigen::Vector3d nearest = below.cwiseMax (above).cwiseMax (0.0);
      const Eigen::Vector3d farthest = below.cwiseAbs ().cwiseMax (above.cwiseAbs ());
      const bool outside = nearest.squaredNorm () > sqr_radius;
      const bool inside = farthest.squaredNorm () <= sqr_radius;
      if (inside)
        found += node.last - node.first;
      else if (!outside && node.leaf)
        for (Index i = node.first; i < node.last; ++i)
          found += (points_[i] - centre).squaredNorm () <= sqr_radius ? 1 : 0;
      n = inside || outside || node.leaf ? node.skip : n + 1;
    }
    return found;
  }

private:
  static constexpr Index LEAF_SIZE = 8;

  // Nodes are in depth-first order.
  struct Node
  {
    Eigen::Vector3d lower, upper;
    Index first, last;
    std::size_t skip; // the next node that is not below this one
    bool leaf;
  };

  void build (Index first, Index last)
  {
    Node node{points_[first], points_[first], first, last, 0, last - first <= LEAF_SIZE};
    for (Index i = first; i < last; ++i) {
      node.lower = node.lower.cwiseMin (points_[i]);
      node.upper = node.upper.cwiseMax (points_[i]);
    }
    const std::size_t self = nodes_.size ();
    nodes_.push_back (node);
    if (!node.leaf) {
      Eigen::Index axis = 0;
      (node.upper - node.lower).maxCoeff (&axis);
      const Index middle = first + (last - first) / 2;
      std::nth_element (points_.begin () + first, points_.begin () + middle,
                        points_.begin () + last,
                        [axis] (const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
                          return a[axis] < b[axis];
                        });
      build (first, middle);
      build (middle, last);
    }
    nodes_[self].skip = nodes_.size ();
  }

  std::vector<Eigen::Vector3d> points_;
  std::vector<Node> nodes_;
};

// Indices of the points in the list, by descending number of points around; ties in the order of
// the list.
std::vector<Index>
byDescendingDensity (const std::vector<Eigen::Vector3d>& points, double radius,
                     const RunContext& run)
{
  ProgressLoop progress (run, points.size ());
  const SphereCounter counter (points);
  std::vector<std::size_t> density (points.size ());
  for (std::size_t i = 0; i < points.size (); ++i) {
    progress.next ();
    density[i] = counter.count (points[i], radius * radius);
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
  const std::vector<Index> starts = byDescendingDensity (points, tolerance, run);
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
