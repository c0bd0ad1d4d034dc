// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/clusters.h"

#include "points/kd_tree.h"

#include <algorithm>
#include <numeric>

namespace pcl::floater {
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
