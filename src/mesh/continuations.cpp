// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/continuations.h"

#include "core/geometry.h"
#include "core/parallel.h"
#include "points/kd_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace pcl::floater {
namespace {
using Positions = std::vector<Eigen::Vector3d>;

struct OpenEdge
{
  Index component;
  double length;
  Eigen::Vector3d along; // unit length, the surface on the left
  Eigen::Vector3d ahead; // unit length, in the plane of the triangle, away from it
};

struct BoundaryEdges
{
  std::vector<OpenEdge> edges;
  Positions middles;
  std::vector<double> length, mean_length; // of all edges of each component, and of one
  std::size_t components = 0;              // that have any
};

// Averages directions with those of the edges before and after, since borders are ragged.
// \param ends of each edge
void
smoothDirections (std::vector<OpenEdge>& edges, const std::vector<std::array<Index, 2>>& ends,
                  std::size_t points)
{
  std::vector<Index> from (points, NONE), to (points, NONE); // edges by their end points
  for (Index i = 0; i < ends.size (); ++i) {
    from[ends[i][0]] = i;
    to[ends[i][1]] = i;
  }
  const std::vector<OpenEdge> rough = edges;
  for (Index i = 0; i < edges.size (); ++i)
    for (const Index j : {to[ends[i][0]], from[ends[i][1]]}) {
      edges[i].along += rough[j].along;
      edges[i].ahead += rough[j].ahead;
    }
  for (OpenEdge& edge : edges) {
    edge.along.normalize ();
    edge.ahead.normalize ();
  }
}

BoundaryEdges
findBoundaryEdges (const TriangleMesh& mesh, const MeshComponents& components,
                   const Positions& positions, const RunContext& run)
{
  BoundaryEdges boundary;
  boundary.length.assign (components.count, 0.0);
  std::vector<std::size_t> count (components.count, 0);
  std::vector<std::array<Index, 2>> ends;
  ProgressLoop progress (run);
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    progress.next ();
    for (std::uint8_t side = 0; side < 3; ++side) {
      if (mesh.neighbors[t][side] != NONE)
        continue;
      const MeshEdge edge{t, side};
      const Eigen::Vector3d &from = positions[mesh.from (edge)], &to = positions[mesh.to (edge)];
      const Eigen::Vector3d along = (to - from).normalized ();
      const Eigen::Vector3d normal =
          areaVector (positions[mesh.corner (edge)], from, to).normalized ();
      const Index component = components.of_triangle[t];
      boundary.edges.push_back ({component, (to - from).norm (), along, along.cross (normal)});
      boundary.middles.emplace_back (0.5 * (from + to));
      ends.push_back ({mesh.from (edge), mesh.to (edge)});
      boundary.length[component] += boundary.edges.back ().length;
      ++count[component];
    }
  }
  smoothDirections (boundary.edges, ends, positions.size ());
  for (std::size_t c = 0; c < count.size (); ++c) {
    boundary.mean_length.push_back (boundary.length[c] /
                                    static_cast<double> (std::max<std::size_t> (count[c], 1)));
    boundary.components += count[c] > 0 ? 1 : 0;
  }
  return boundary;
}

// How well one edge continues another: positive if their fronts are on the same side.
double
agreement (const OpenEdge& one, const OpenEdge& other, const Eigen::Vector3d& across, double cosine)
{
  const double ahead = across.dot (one.ahead), back = -across.dot (other.ahead);
  return ahead >= cosine && back >= cosine ? -one.along.dot (other.along) * ahead * back : 0.0;
}

struct Vote
{
  Index other = NONE; // NONE: not continued by another component
  double weight = 0.0;
};

std::vector<Vote>
vote (const BoundaryEdges& boundary, const ContinuationLimits& limits, const RunContext& run)
{
  const KdTree tree (boundary.middles, run);
  std::vector<Vote> votes (boundary.edges.size ());
  parallelRanges (run, votes.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Neighbor> found;
    for (std::size_t i = first; i < last; ++i) {
      const OpenEdge& edge = boundary.edges[i];
      const auto to = [&] (Index j, const Eigen::Vector3d& middle) {
        return agreement (edge, boundary.edges[j], (middle - boundary.middles[i]).normalized (),
                          limits.cosine);
      };
      tree.nearestIf (
          boundary.middles[i], edge.ahead, limits.reach * boundary.mean_length[edge.component], 1,
          [&] (const Neighbor& near, const Eigen::Vector3d& middle) {
            return std::abs (to (near.point, middle)) > 0.0;
          },
          found);
      if (found.empty ())
        continue;
      const Index j = found.front ().point;
      if (boundary.edges[j].component != edge.component)
        votes[i] = {boundary.edges[j].component, edge.length * to (j, boundary.middles[j])};
    }
  });
  return votes;
}

} // namespace

std::vector<Continuation>
findContinuations (const TriangleMesh& mesh, const MeshComponents& components,
                   const std::vector<Eigen::Vector3d>& positions, const ContinuationLimits& limits,
                   const RunContext& run)
{
  if (components.count < 2)
    return {};
  const BoundaryEdges boundary = findBoundaryEdges (mesh, components, positions, run);
  if (boundary.components < 2)
    return {};
  struct Sum
  {
    double signed_weight = 0.0, weight = 0.0;
  };
  std::map<std::pair<Index, Index>, Sum> sums;
  const std::vector<Vote> votes = vote (boundary, limits, run);
  for (std::size_t i = 0; i < votes.size (); ++i)
    if (votes[i].other != NONE) {
      Sum& sum = sums[std::minmax (boundary.edges[i].component, votes[i].other)];
      sum.signed_weight += votes[i].weight;
      sum.weight += std::abs (votes[i].weight);
    }
  std::vector<Continuation> found;
  for (const auto& [pair, sum] : sums) {
    const auto [a, b] = pair;
    const double support = std::abs (sum.signed_weight);
    if (support >= limits.agreement * sum.weight &&
        support >= limits.support * std::min (boundary.length[a], boundary.length[b]))
      found.push_back ({a, b, sum.signed_weight < 0.0, support});
  }
  return found;
}

} // namespace pcl::floater
