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

// What is around a vertex.
struct Surroundings
{
  double outwards = 0.0, inwards = 0.0; // sums of the angles at its edges
  std::size_t edges = 0;                // that are inside
  std::vector<Index> neighbors;         // in order
  bool is_boundary = false;             // then the first and the last neighbour are on it
};

void
lookAround (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            const std::vector<Eigen::Vector3d>& area_vectors, Index point, std::vector<Index>& fan,
            Surroundings& around)
{
  around.outwards = around.inwards = 0.0;
  around.edges = 0;
  around.neighbors.clear ();
  mesh.fan (point, fan);
  for (const Index t : fan) {
    const std::uint8_t corner = mesh.sideOf (t, point);
    const std::uint8_t after = TriangleMesh::next (corner),
                       before = TriangleMesh::previous (corner);
    around.neighbors.push_back (mesh.triangles[t][after]);
    // The edge to that neighbour is the side opposite to the corner before.
    if (mesh.neighbors[t][before] == NONE)
      continue;
    const double bend = bendAt (mesh, positions, area_vectors, {t, before});
    (bend > 0.0 ? around.outwards : around.inwards) += std::abs (bend);
    ++around.edges;
  }
  around.is_boundary = around.edges < fan.size ();
  if (around.is_boundary) {
    const Index last = fan.back ();
    around.neighbors.push_back (
        mesh.triangles[last][TriangleMesh::previous (mesh.sideOf (last, point))]);
  }
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
  std::vector<std::uint8_t> bends_both_ways (positions.size ());
  for (int round = 0; round < limits.rounds; ++round) {
    const std::vector<Eigen::Vector3d> area_vectors = areaVectors (mesh, current, run);
    const auto visit = [&] (const auto& work) {
      parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t last) {
        std::vector<Index> fan;
        Surroundings around;
        for (std::size_t p = first; p < last; ++p)
          if (mesh.triangle_of[p] != NONE) {
            lookAround (mesh, current, area_vectors, static_cast<Index> (p), fan, around);
            work (p, around);
          }
      });
    };
    visit ([&] (std::size_t p, const Surroundings& around) {
      bends_both_ways[p] = std::min (around.outwards, around.inwards) >
                                   limits.bend * static_cast<double> (around.edges)
                               ? 1
                               : 0;
    });
    next = current;
    std::atomic<bool> has_moved{false};
    visit ([&] (std::size_t p, const Surroundings& around) {
      // Where creases of both kinds meet, only one vertex bends both ways.
      const auto beside = std::count_if (around.neighbors.begin (), around.neighbors.end (),
                                         [&] (Index q) { return bends_both_ways[q] != 0; });
      if (bends_both_ways[p] == 0 ||
          2 * static_cast<std::size_t> (beside) < around.neighbors.size ())
        return;
      next[p] = meanOf (current, around);
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
