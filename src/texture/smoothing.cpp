// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/smoothing.h"

#include "core/parallel.h"
#include "texture/facets.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
// The angle between the normals on both sides of an edge: positive where the surface bends
// outwards.
double
bendAt (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
        const std::vector<Eigen::Vector3d>& area_vectors, MeshEdge edge)
{
  const Eigen::Vector3d& here = area_vectors[edge.triangle];
  const Eigen::Vector3d& beyond = area_vectors[mesh.neighbors[edge.triangle][edge.side]];
  const Eigen::Vector3d along = positions[mesh.to (edge)] - positions[mesh.from (edge)];
  const Eigen::Vector3d turn = here.cross (beyond);
  const double angle = std::atan2 (turn.norm (), here.dot (beyond));
  return turn.dot (along) >= 0.0 ? angle : -angle;
}

// The angles at the edges of a vertex, or of several.
struct Bends
{
  double outwards = 0.0, inwards = 0.0; // sums
  std::size_t edges = 0;                // that are inside
};

// What is around a vertex.
struct Surroundings
{
  std::vector<Index> neighbors; // in order
  bool is_boundary = false;     // then the first and the last neighbour are on it
};

void
lookAround (const TriangleMesh& mesh, Index point, std::vector<Index>& fan, Surroundings& around)
{
  around.neighbors.clear ();
  mesh.fan (point, fan);
  const auto corner = [&] (Index t, std::uint8_t (*side) (std::uint8_t)) {
    return mesh.triangles[t][side (mesh.sideOf (t, point))];
  };
  for (const Index t : fan)
    around.neighbors.push_back (corner (t, TriangleMesh::next));
  const Index last = corner (fan.back (), TriangleMesh::previous);
  around.is_boundary = last != around.neighbors.front ();
  if (around.is_boundary)
    around.neighbors.push_back (last);
}

// Of the edges at a vertex.
Bends
bendsOf (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
         const std::vector<Eigen::Vector3d>& area_vectors, Index point, std::vector<Index>& fan)
{
  Bends bends;
  mesh.fan (point, fan);
  for (const Index t : fan) {
    // The edge that leaves the point in this triangle is the side opposite to the corner before.
    const std::uint8_t side = TriangleMesh::previous (mesh.sideOf (t, point));
    if (mesh.neighbors[t][side] == NONE)
      continue;
    const double bend = bendAt (mesh, positions, area_vectors, {t, side});
    (bend > 0.0 ? bends.outwards : bends.inwards) += std::abs (bend);
    ++bends.edges;
  }
  return bends;
}

Eigen::Vector3d
meanOf (const std::vector<Eigen::Vector3d>& positions, const Surroundings& around)
{
  const std::vector<Index>& neighbors = around.neighbors;
  if (around.is_boundary)
    return 0.5 * (positions[neighbors.front ()] + positions[neighbors.back ()]);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero ();
  for (const Index q : neighbors)
    sum += positions[q];
  return sum / static_cast<double> (neighbors.size ());
}

} // namespace

std::vector<Eigen::Vector3d>
smoothNoise (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const SmoothingLimits& limits, const RunContext& run)
{
  std::vector<Eigen::Vector3d> current = positions, next = positions;
  std::vector<double> reach (positions.size (), 0.0);
  std::vector<Bends> bends (positions.size ());
  std::vector<std::uint8_t> bends_both_ways (positions.size ());
  // Calls work (p, scratch) for every vertex.
  const auto visit = [&] (const auto& work) {
    parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t last) {
      std::vector<Index> fan;
      for (std::size_t p = first; p < last; ++p)
        if (mesh.triangle_of[p] != NONE)
          work (static_cast<Index> (p), fan);
    });
  };
  visit ([&] (Index p, std::vector<Index>& fan) {
    Surroundings around;
    lookAround (mesh, p, fan, around);
    double sum = 0.0;
    for (const Index q : around.neighbors)
      sum += (positions[q] - positions[p]).norm ();
    reach[p] = limits.farthest * sum / static_cast<double> (around.neighbors.size ());
  });
  for (int round = 0; round < limits.rounds; ++round) {
    const std::vector<Eigen::Vector3d> area_vectors = areaVectors (mesh, current, run);
    visit ([&] (Index p, std::vector<Index>& fan) {
      bends[p] = bendsOf (mesh, current, area_vectors, p, fan);
    });
    visit ([&] (Index p, std::vector<Index>& fan) {
      // A peak alone bends one way only; so the vertices beside it count as well.
      bends_both_ways[p] = 0;
      const double all = bends[p].outwards + bends[p].inwards;
      if (all <= limits.bend * static_cast<double> (bends[p].edges))
        return;
      Surroundings around;
      lookAround (mesh, p, fan, around);
      Bends sum = bends[p];
      for (const Index q : around.neighbors) {
        sum.outwards += bends[q].outwards;
        sum.inwards += bends[q].inwards;
        sum.edges += bends[q].edges;
      }
      const double least = limits.bend * static_cast<double> (sum.edges);
      bends_both_ways[p] = std::min (sum.outwards, sum.inwards) > least ? 1 : 0;
    });
    next = current;
    std::atomic<bool> has_moved{false};
    visit ([&] (Index p, std::vector<Index>& fan) {
      if (bends_both_ways[p] == 0)
        return;
      Surroundings around;
      lookAround (mesh, p, fan, around);
      // Where creases of both kinds meet, only one vertex bends both ways.
      const auto beside = static_cast<std::size_t> (
          std::count_if (around.neighbors.begin (), around.neighbors.end (),
                         [&] (Index q) { return bends_both_ways[q] != 0; }));
      if (2 * beside < around.neighbors.size ())
        return;
      const Eigen::Vector3d way = meanOf (current, around) - positions[p];
      const double length = way.norm ();
      next[p] = length > reach[p] ? Eigen::Vector3d (positions[p] + reach[p] / length * way)
                                  : Eigen::Vector3d (positions[p] + way);
      has_moved = true;
    });
    if (!has_moved)
      break;
    current.swap (next);
  }
  return current;
}

} // namespace floater
} // namespace pcl
