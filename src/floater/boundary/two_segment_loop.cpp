// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/two_segment_loop.h"

#include "floater/boundary/neighbor_graph.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
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

/// Appends points to a segment that begins with `seed` until it has `size` points.
///
/// k is a property of the moment: neighbours up to the third come first, and a farther one is taken
/// only when all of those are in the segment. Among candidates of one k the report leaves the
/// choice open; the one nearest to the seed along the segment makes both ends advance alike, so
/// that the last point appended lies at an end.
std::vector<Index>
growSegment (const Positions& points, Index seed, std::size_t size)
{
  std::vector<NeighborEdge> edges = neighborGraph (points, LARGEST_K);
  const std::size_t half = edges.size ();
  for (std::size_t e = 0; e < half; ++e)
    edges.push_back ({edges[e].b, edges[e].a, edges[e].rank, edges[e].length});
  std::sort (edges.begin (), edges.end (), [] (const NeighborEdge& e, const NeighborEdge& f) {
    return std::tie (e.a, e.b) < std::tie (f.a, f.b);
  });
  std::vector<std::size_t> offsets (points.size () + 1, 0);
  for (const NeighborEdge& edge : edges)
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
/// other point a convex combination of its neighbours with weights proportional to 1 / distance.
/// Each row is multiplied by its sum of 1 / distance: the matrix is then symmetric, and positive
/// definite as the graph is connected.
/// \return points ascending in t; empty if two points coincide or the system is singular
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
  const std::vector<NeighborEdge> graph = neighborGraph (points, LARGEST_K);
  const Index size = static_cast<Index> (points.size ());
  std::vector<Index> shortest;
  double shortest_length = std::numeric_limits<double>::infinity ();
  for (const Index k : UNIVARIATE_K) {
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
