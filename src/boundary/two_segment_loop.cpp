// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundary/two_segment_loop.h"

#include "neighborhoods/kd_tree.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

namespace pcl
{
namespace floater
{
namespace
{
using Positions = std::vector<Eigen::Vector3d>;

/// k at which a segment begins to grow (TW 385, section 3.3).
constexpr Index GROWING_K = 3;
/// k up to which it may be incremented; beyond, a segment goes on over the bridges of the graph.
constexpr Index LARGEST_K = 16;
/// Neighbours of a point in the univariate parameterization: the shortest order of these is taken.
constexpr std::array<Index, 3> UNIVARIATE_K = {3, 4, 5};

/// Two neighbours. rank: 0 if one is the nearest point of the other, 1 if the second nearest, ...
struct Edge
{
  Index a, b; ///< a < b
  Index rank;
  double length;
};

/// Disjoint sets of points.
class Components
{
public:
  explicit Components (std::size_t size) : parent_ (size)
  {
    std::iota (parent_.begin (), parent_.end (), Index{0});
  }

  Index find (Index p)
  {
    while (parent_[p] != p)
      p = parent_[p] = parent_[parent_[p]];
    return p;
  }

  /// \return false if they were in the same set
  bool join (Index p, Index q)
  {
    p = find (p);
    q = find (q);
    parent_[std::max (p, q)] = std::min (p, q);
    return p != q;
  }

private:
  std::vector<Index> parent_;
};

/// Shortest edge from each component to another, at its smallest point; NONE if there is only one.
///
/// Labels of different components differ in a bit: the nearest point of another component is found
/// among trees of all points that differ in one bit, without a tree for each component.
std::vector<Edge>
shortestBridges (const Positions& points, const std::vector<Index>& labels, Index components)
{
  const auto less = [] (const Edge& e, const Edge& f) {
    return std::tie (e.length, e.a, e.b) < std::tie (f.length, f.a, f.b);
  };
  const double infinity = std::numeric_limits<double>::infinity ();
  std::vector<Edge> shortest (components, Edge{NONE, NONE, LARGEST_K, infinity});
  std::vector<Neighbor> nearest;
  for (Index bit = 1; bit < components; bit *= 2)
    for (const Index side : {Index{0}, bit}) {
      std::vector<Index> ids;
      Positions others;
      for (Index p = 0; p < points.size (); ++p)
        if ((labels[p] & bit) == side) {
          ids.push_back (p);
          others.push_back (points[p]);
        }
      const KdTree tree (others);
      for (Index p = 0; p < points.size (); ++p)
        if ((labels[p] & bit) != side) {
          tree.nearest (points[p], 1, nearest);
          if (nearest.empty ())
            continue;
          const Index q = ids[nearest[0].point];
          const Edge edge{std::min (p, q), std::max (p, q), LARGEST_K,
                          std::sqrt (nearest[0].sqr_distance)};
          Edge& best = shortest[labels[p]];
          if (less (edge, best))
            best = edge;
        }
    }
  return shortest;
}

/// Graph of the k nearest neighbours, symmetric and connected: gaps that no neighbourhood spans are
/// bridged where they are narrowest (Boruvka's algorithm), with rank LARGEST_K. Sorted by (a, b).
std::vector<Edge>
neighborGraph (const Positions& points, Index k)
{
  const KdTree tree (points);
  std::vector<Edge> edges;
  std::vector<Neighbor> nearest;
  for (Index p = 0; p < points.size (); ++p) {
    tree.nearest (points[p], std::size_t{k} + 1, nearest);
    Index rank = 0;
    for (const Neighbor& neighbor : nearest)
      if (neighbor.point != p && rank < k)
        edges.push_back ({std::min (p, neighbor.point), std::max (p, neighbor.point), rank++,
                          std::sqrt (neighbor.sqr_distance)});
  }

  Components sets (points.size ());
  for (const Edge& edge : edges)
    sets.join (edge.a, edge.b);
  while (true) {
    std::vector<Index> labels (points.size ());
    Index components = 0;
    for (Index p = 0; p < points.size (); ++p) {
      const Index root = sets.find (p); // the smallest point of its set
      labels[p] = root == p ? components++ : labels[root];
    }
    if (components < 2)
      break;
    for (const Edge& bridge : shortestBridges (points, labels, components))
      if (sets.join (bridge.a, bridge.b))
        edges.push_back (bridge);
  }

  std::sort (edges.begin (), edges.end (), [] (const Edge& e, const Edge& f) {
    return std::tie (e.a, e.b, e.rank) < std::tie (f.a, f.b, f.rank);
  });
  const auto same = [] (const Edge& e, const Edge& f) { return e.a == f.a && e.b == f.b; };
  edges.erase (std::unique (edges.begin (), edges.end (), same), edges.end ());
  return edges;
}

/// Appends points to a segment that begins with `seed` until it has `size` points.
///
/// k is a property of the moment: neighbours up to the third come first, and a farther one is taken
/// only when all of those are in the segment. Among candidates of one k the report leaves the
/// choice open; the one nearest to the seed along the segment makes both ends advance alike, so
/// that the last point appended lies at an end.
std::vector<Index>
growSegment (const Positions& points, Index seed, std::size_t size)
{
  std::vector<Edge> edges = neighborGraph (points, LARGEST_K);
  const std::size_t half = edges.size ();
  for (std::size_t e = 0; e < half; ++e)
    edges.push_back ({edges[e].b, edges[e].a, edges[e].rank, edges[e].length});
  std::sort (edges.begin (), edges.end (), [] (const Edge& e, const Edge& f) {
    return std::tie (e.a, e.b) < std::tie (f.a, f.b);
  });
  std::vector<std::size_t> offsets (points.size () + 1, 0);
  for (const Edge& edge : edges)
    ++offsets[edge.a + 1];
  std::partial_sum (offsets.begin (), offsets.end (), offsets.begin ());

  // (k - 1, length of the path from the seed, point)
  using Candidate = std::tuple<Index, double, Index>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
  std::vector<std::uint8_t> appended (points.size (), 0);
  std::vector<Index> segment;
  candidates.emplace (0, 0.0, seed);
  while (segment.size () < size && !candidates.empty ()) {
    const auto [rank, path, p] = candidates.top ();
    candidates.pop ();
    if (appended[p])
      continue;
    appended[p] = 1;
    segment.push_back (p);
    for (std::size_t e = offsets[p]; e < offsets[p + 1]; ++e)
      if (!appended[edges[e].b])
        candidates.emplace (std::max (edges[e].rank, GROWING_K - 1), path + edges[e].length,
                            edges[e].b);
  }
  return segment;
}

/// Univariate Floater parameterization: t = 0 at the first point, t = 1 at the last one, every
/// other point a convex combination of its k neighbours with weights proportional to 1 / distance.
/// Each row is multiplied by its sum of 1 / distance: the matrix is then symmetric, and positive
/// definite as the graph is connected. \return rows of `points` ascending in t; empty if the system
/// is singular
std::vector<Index>
univariateOrder (const Positions& points, Index k)
{
  const Index last = static_cast<Index> (points.size ()) - 1;
  const Eigen::Index unknowns = static_cast<Eigen::Index> (points.size ()) - 2;
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
  for (const Edge& edge : neighborGraph (points, k)) {
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

  std::vector<Index> order (points.size ());
  std::iota (order.begin (), order.end (), Index{0});
  std::stable_sort (order.begin () + 1, order.end () - 1,
                    [&t] (Index p, Index q) { return t[p - 1] < t[q - 1]; });
  return order;
}

/// Orders a segment, whose ends are its first and last point. How many neighbours serve best
/// depends on the jags of the border: too few leave some of them hanging at one parameter, too many
/// smooth them out. Both show as a longer way through the points.
std::vector<Index>
orderSegment (const Positions& positions, const std::vector<Index>& segment)
{
  Positions points;
  points.reserve (segment.size ());
  for (const Index p : segment)
    points.push_back (positions[p]);
  std::vector<Index> shortest;
  double shortest_length = std::numeric_limits<double>::infinity ();
  for (const Index k : UNIVARIATE_K) {
    std::vector<Index> order = univariateOrder (points, k);
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
twoSegmentLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& cluster)
{
  if (cluster.size () < 4)
    return {};
  Positions points;
  points.reserve (cluster.size ());
  for (const Index p : cluster)
    points.push_back (positions[p]);

  std::vector<Index> segment1 = growSegment (points, 0, points.size () / 2 + 1);

  // Segment 2 begins at the end of segment 1 and takes all that is left.
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
  const Index segment2_last = growSegment (points2, 0, points2.size ()).back ();
  std::swap (segment2[segment2_last], segment2.back ());

  // The end of segment 2 is the start of segment 1.
  segment1.insert (segment1.begin (), segment2.back ());
  std::vector<Index> loop = orderSegment (points, segment1);
  const std::vector<Index> way_back = orderSegment (points, segment2);
  if (loop.empty () || way_back.empty ())
    return {};
  loop.insert (loop.end (), way_back.begin () + 1, way_back.end () - 1);
  for (Index& p : loop)
    p = cluster[p];
  return loop;
}

} // namespace floater
} // namespace pcl
