// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/boundary.h"

#include "core/disjoint_sets.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "local/planar_star.h"
#include "points/kd_tree.h"

#include <Eigen/SparseCholesky>

#include <queue>
#include <unordered_map>

namespace pcl::floater {
namespace {
// k at which a segment begins to grow (TW 385, section 3.3).
constexpr Index FIRST_K = 3;

// k up to which it is incremented, or that of the cluster, if it is larger: its points are connected by
// that many neighbours. Tested on generated borders only; not certain.
constexpr int LARGEST_K = 16;

// Numbers of neighbours that are tried in the univariate parameterization; the shortest order is taken.
// Tested on generated borders, smooth and jagged; not certain.
constexpr std::array<Index, 3> UNIVARIATE_K{3, 4, 5};

// Fewest points of a found loop in a cloud of more than FEW_POINTS points. A shorter loop is a gap in
// the sampling of a closed surface. Of the real discs, the shortest boundary has 36 points; not certain.
constexpr std::size_t SHORTEST_LOOP = 10;
constexpr std::size_t FEW_POINTS = 100; // not derived from data

// An edge between two neighbouring points.
struct NeighborEdge
{
  Index a, b;    // a < b
  Index rank;    // 0 if one point is the nearest of the other, 1 if it is the second nearest, ...
  double length; // distance
};

// The k nearest neighbours of every point as a symmetric graph. O(n (k + log n)).
// \return each pair once, with the smaller of its two ranks, ascending in (a, b)
std::vector<NeighborEdge>
neighborGraph (const Positions& points, Index k, const RunContext& run)
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
  std::sort (edges.begin (), edges.end (), [] (const NeighborEdge& e, const NeighborEdge& f) {
    return std::tie (e.a, e.b, e.rank) < std::tie (f.a, f.b, f.rank);
  });
  const auto same = [] (const NeighborEdge& e, const NeighborEdge& f) {
    return e.a == f.a && e.b == f.b;
  };
  edges.erase (std::unique (edges.begin (), edges.end (), same), edges.end ());
  return edges;
}

// The part of a connected graph in which edges have a rank below k, and the shortest others that
// keep it connected. O(edges log edges).
// \param size points of the graph
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

// Makes a segment of `size` points, or fewer, that begins with point 0, the seed.
//
// The FIRST_K nearest neighbours of the points in the segment come first. A farther neighbour is
// appended only if these are exhausted. TW 385 leaves open which of several candidates of one rank
// comes first. Here it is the nearest to the seed along the segment: both ends then advance alike,
// and the last point appended is an end.
std::vector<Index>
growSegment (const Positions& points, std::size_t size, Index largest_k, const RunContext& run)
{
  const std::vector<NeighborEdge> edges = neighborGraph (points, largest_k, run);
  const CsrLists edges_of_point = makeCsrLists (points.size (), [&edges] (const auto& emit) {
    for (Index e = 0; e < edges.size (); ++e) {
      emit (edges[e].a, e);
      emit (edges[e].b, e);
    }
  });

  // Rank, length of the path from the seed, point.
  using Candidate = std::tuple<Index, double, Index>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
  Flags appended (points.size (), 0);
  std::vector<Index> segment;
  candidates.emplace (0, 0.0, 0);
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
        candidates.emplace (std::max (edge.rank, FIRST_K - 1), path + edge.length, q);
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

  std::vector<Index> order = indicesBelow (size);
  std::stable_sort (order.begin () + 1, order.end () - 1,
                    [&t] (Index p, Index q) { return t[p - 1] < t[q - 1]; });
  return order;
}

// Orders a segment between its ends, its first and its last point. The best number of neighbours
// depends on the jags of the border: with too few, several points get the same parameter; with too
// many, jags are smoothed out. Both make the path through the points longer, so the shortest order
// is used.
std::vector<Index>
orderSegment (const Positions& positions, const std::vector<Index>& segment, Index largest_k,
              const RunContext& run)
{
  const Positions points = valuesAt (positions, segment);
  const std::vector<NeighborEdge> graph = neighborGraph (points, largest_k, run);
  const Index size = static_cast<Index> (points.size ());
  std::vector<Index> shortest;
  double shortest_length = std::numeric_limits<double>::infinity ();
  for (const Index k : UNIVARIATE_K) {
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
  return valuesAt (segment, shortest);
}

} // namespace

std::vector<std::vector<Index>>
clusterBoundaryPoints (const Positions& positions, const std::vector<Index>& boundary_points,
                       double tolerance, int k, const RunContext& run)
{
  const Positions points = valuesAt (positions, boundary_points);
  const KdTree tree (points, run);
  const std::size_t appended = static_cast<std::size_t> (std::max (k, 0));
  Flags taken (points.size (), 0);
  std::vector<Neighbor> nearest;
  std::vector<std::vector<Index>> clusters;
  // By descending number of points around; ties in the order of the list.
  ProgressLoop progress (run, 2 * points.size ());
  std::vector<std::size_t> density;
  std::vector<Index> around;
  for (const Vector3d& point : points) {
    progress.next ();
    tree.collect (point, tolerance, points.size (), around);
    density.push_back (around.size ());
  }
  std::vector<Index> starts = indicesBelow (points.size ());
  std::stable_sort (starts.begin (), starts.end (),
                    [&density] (Index a, Index b) { return density[a] > density[b]; });
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
    cluster = valuesAt (boundary_points, cluster);
    std::sort (cluster.begin (), cluster.end ());
    clusters.push_back (std::move (cluster));
  }
  std::sort (clusters.begin (), clusters.end (),
             [] (const std::vector<Index>& a, const std::vector<Index>& b) {
               return a.size () != b.size () ? a.size () > b.size () : a.front () < b.front ();
             });
  return clusters;
}

std::vector<Index>
twoSegmentLoop (const Positions& positions, const std::vector<Index>& cluster, int cluster_k,
                const RunContext& run)
{
  if (cluster.size () < 4)
    return {};
  const auto largest_k = static_cast<Index> (std::max (LARGEST_K, cluster_k));
  const Positions points = valuesAt (positions, cluster);
  std::vector<Index> segment1 = growSegment (points, points.size () / 2 + 1, largest_k, run);

  // Segment 2 grows from the end of segment 1 among all other points. Those that it does not reach
  // are beside segment 1.
  const auto others = [&points] (std::vector<Index> segment) {
    std::vector<Index> list = indicesBelow (points.size ());
    std::sort (segment.begin (), segment.end ());
    eraseRows (list, segment);
    return list;
  };
  const Index end = segment1.back ();
  std::vector<Index> segment2 = others (segment1);
  segment2.insert (segment2.begin (), end);
  segment2 = valuesAt (segment2,
                       growSegment (valuesAt (points, segment2), segment2.size (), largest_k, run));
  segment1 = others (segment2);
  segment1.push_back (end);

  // The end of segment 2 is the start of segment 1.
  segment1.insert (segment1.begin (), segment2.back ());
  std::vector<Index> loop = orderSegment (points, segment1, largest_k, run);
  const std::vector<Index> way_back = orderSegment (points, segment2, largest_k, run);
  if (loop.empty () || way_back.empty ())
    return {};
  loop.insert (loop.end (), way_back.begin () + 1, way_back.end () - 1);
  return valuesAt (cluster, loop);
}

Boundary
givenLoop (const Points& points, const std::vector<Index>& loop)
{
  Boundary boundary;
  const auto invalid = [&] (const std::string& why) {
    boundary.problem = {RunStatus::INVALID_LOOP, "the given boundary loop " + why};
    boundary.loop.clear ();
    return boundary;
  };
  std::unordered_map<Index, Index> point_of; // by cloud index
  for (Index p = 0; p < points.cloud_index.size (); ++p)
    point_of.emplace (points.cloud_index[p], p);
  for (const auto& [duplicate, kept] : points.duplicates)
    if (const auto at = point_of.find (kept); at != point_of.end ())
      point_of.emplace (duplicate, at->second);
  Flags seen (points.positions.size (), 0);
  for (const Index cloud_index : loop) {
    const auto at = point_of.find (cloud_index);
    const Index p = at != point_of.end () ? at->second : NONE;
    if (p == NONE)
      return invalid ("names point " + std::to_string (cloud_index) +
                      ", which is not in the cloud, not selected, or not finite");
    if (seen[p] != 0)
      return invalid ("passes twice through point " + std::to_string (cloud_index));
    seen[p] = 1;
    boundary.loop.push_back (p);
  }
  if (boundary.loop.size () < 3)
    return invalid ("has fewer than 3 points");
  boundary.candidates = boundary.loop.size ();
  return boundary;
}

Boundary
publishedLoop (const Points& points, const LocalGeometry& geometry, const BoundaryOptions& options,
               const RunContext& run)
{
  const Positions& positions = points.workingPositions ();
  // The widest sector without a neighbour in the tangent plane exceeds the opening angle.
  Flags is_candidate (positions.size (), 0);
  parallelPoints<PlanarStar, std::vector<PlanarNeighbor>> (
      run, positions.size (), [&] (Index p, auto& star, auto& planar) {
        const TangentFrame frame (geometry.stars.normals[p].cast<double> ());
        planar.clear ();
        for (const Index q : geometry.neighbors.row (p)) {
          const Vector2d projected = frame.project (positions[q] - positions[p]);
          if (projected != Vector2d::Zero ())
            planar.push_back ({projected, q});
        }
        star.make (planar);
        is_candidate[p] = star.openingAngle () > options.opening_angle * DEGREE ? 1 : 0;
      });
  const std::vector<Index> candidates =
      indicesWhere (positions.size (), [&] (Index p) { return is_candidate[p] != 0; });
  Boundary boundary;
  boundary.candidates = candidates.size ();
  const std::vector<std::vector<Index>> clusters = clusterBoundaryPoints (
      positions, candidates, options.cluster_tolerance * points.diagonal, options.cluster_k, run);
  if (!clusters.empty ())
    boundary.loop = twoSegmentLoop (positions, clusters.front (), options.cluster_k, run);
  return boundary;
}

void
checkBoundary (const Points& points, const std::vector<float>& spacing, bool is_given,
               Boundary& boundary)
{
  if (boundary.problem)
    return;
  const bool is_mere_gap =
      !is_given && boundary.loop.size () < SHORTEST_LOOP && points.size () > FEW_POINTS;
  if (boundary.loop.size () < 3 || is_mere_gap) {
    boundary.loop.clear ();
    boundary.problem = {
        RunStatus::NO_BOUNDARY,
        "no boundary loop was found among " + std::to_string (boundary.candidates) +
            (boundary.candidates == 1 ? " boundary point" : " boundary points") +
            ": the surface seems to be closed, or it is not one disc; cut it open, or give the "
            "loop"};
  }
  const Positions& positions = points.workingPositions ();
  for (std::size_t i = 0; i < boundary.loop.size (); ++i) {
    const Index p = boundary.loop[i];
    const Index q = boundary.loop[(i + 1) % boundary.loop.size ()];
    const double step = (positions[p] - positions[q]).norm () / (0.5 * (spacing[p] + spacing[q]));
    if (step > boundary.largest_step) {
      boundary.largest_step = step;
      boundary.longest_from = p;
    }
  }
}

} // namespace pcl::floater
