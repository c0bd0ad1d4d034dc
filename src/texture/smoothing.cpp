// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/smoothing.h"

#include "core/parallel.h"
#include "texture/chart_mesh.h"
#include "texture/charts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace pcl::floater {
namespace {
// Angles at the edges of one or several vertices.
struct Bends
{
  double outwards = 0.0, inwards = 0.0; // sums
  std::size_t edges = 0;                // that are inside

  void add (const Bends& other)
  {
    outwards += other.outwards;
    inwards += other.inwards;
    edges += other.edges;
  }

  // The smaller one of the means of outward and inward angles.
  double bothWays () const
  {
    return edges > 0 ? std::min (outwards, inwards) / static_cast<double> (edges) : 0.0;
  }
};

struct Smoother
{
  const TriangleMesh& mesh;
  const std::vector<Eigen::Vector3d>& original; // positions
  const SmoothingLimits& limits;
  const RunContext& run;
  MeshRings rings{mesh};
  std::vector<Bends> bends_at{}; // per point

  std::vector<Eigen::Vector3d> smoothed ()
  {
    bends_at.resize (original.size ());
    std::vector<Eigen::Vector3d> current = original;
    std::vector<std::uint8_t> is_noisy (original.size (), 1);
    measureBends (current, is_noisy);
    is_noisy = findNoise ();
    if (std::find (is_noisy.begin (), is_noisy.end (), 1) == is_noisy.end ())
      return current;
    for (int ring = 0; ring < limits.rings; ++ring)
      is_noisy = widened (is_noisy);
    const std::vector<double> reach = findReach ();
    std::vector<Eigen::Vector3d> next = current;
    for (int round = 0; round < limits.rounds; ++round) {
      measureBends (current, is_noisy);
      std::atomic<bool> has_moved{false};
      visit ([&] (Index p) {
        if (is_noisy[p] == 0 || !(bendsAround (p).bothWays () > limits.smooth)) {
          next[p] = current[p];
          return;
        }
        const Eigen::Vector3d way = targetOf (current, p) - original[p];
        const double length = way.norm ();
        next[p] = original[p] + way * (length > reach[p] ? reach[p] / length : 1.0);
        has_moved = true;
      });
      current.swap (next);
      if (!has_moved)
        break;
    }
    return current;
  }

private:
  // Calls work (p) for every vertex.
  template <typename Work>
  void visit (const Work& work) const
  {
    parallelPoints (run, original.size (), [&] (Index p) {
      if (mesh.triangle_of[p] != NONE)
        work (p);
    });
  }

  // Calls work (q) for every neighbour of a vertex.
  template <typename Work>
  void visitNeighbors (Index p, const Work& work) const
  {
    for (const Index id : rings.leaving.row (p))
      work (mesh.to ({id / 3, static_cast<std::uint8_t> (id % 3)}));
    if (rings.before[p] != NONE)
      work (rings.before[p]);
  }

  // The angle between the normals at an edge: positive where the surface is convex.
  double bendAt (const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<Eigen::Vector3d>& area_vectors, MeshEdge edge) const
  {
    const Eigen::Vector3d& here = area_vectors[edge.triangle];
    const Eigen::Vector3d& beyond = area_vectors[mesh.neighbors[edge.triangle][edge.side]];
    const Eigen::Vector3d along = positions[mesh.to (edge)] - positions[mesh.from (edge)];
    const Eigen::Vector3d turn = here.cross (beyond);
    const double angle = std::atan2 (turn.norm (), here.dot (beyond));
    return turn.dot (along) >= 0.0 ? angle : -angle;
  }

  // Sums the bends of marked vertices.
  void measureBends (const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<std::uint8_t>& is_marked)
  {
    const std::vector<Eigen::Vector3d> area_vectors = areaVectors (mesh, positions, run);
    visit ([&] (Index p) {
      if (is_marked[p] == 0)
        return;
      Bends& bends = bends_at[p] = {};
      for (const Index id : rings.leaving.row (p)) {
        const MeshEdge edge{id / 3, static_cast<std::uint8_t> (id % 3)};
        if (mesh.neighbors[edge.triangle][edge.side] == NONE)
          continue;
        const double bend = bendAt (positions, area_vectors, edge);
        (bend > 0.0 ? bends.outwards : bends.inwards) += std::abs (bend);
        ++bends.edges;
      }
    });
  }

  // A single peak bends one way only, so adjacent vertices count as well.
  Bends bendsAround (Index p) const
  {
    Bends sum = bends_at[p];
    visitNeighbors (p, [&] (Index q) { sum.add (bends_at[q]); });
    return sum;
  }

  std::vector<std::uint8_t> findNoise () const
  {
    std::vector<std::uint8_t> bends_both_ways (original.size (), 0);
    visit ([&] (Index p) {
      const Bends& own = bends_at[p];
      if (own.outwards + own.inwards > limits.bend * static_cast<double> (own.edges))
        bends_both_ways[p] = bendsAround (p).bothWays () > limits.bend ? 1 : 0;
    });
    // Where creases of both kinds meet, only one vertex bends both ways.
    std::vector<std::uint8_t> is_noisy (original.size (), 0);
    visit ([&] (Index p) {
      if (bends_both_ways[p] == 0)
        return;
      std::size_t neighbors = 0, beside = 0;
      visitNeighbors (p, [&] (Index q) {
        ++neighbors;
        beside += bends_both_ways[q];
      });
      is_noisy[p] = 2 * beside >= neighbors ? 1 : 0;
    });
    return is_noisy;
  }

  // The largest value of each vertex and those around it.
  template <typename Value>
  std::vector<Value> widened (const std::vector<Value>& values) const
  {
    std::vector<Value> wider = values;
    visit ([&] (Index p) {
      visitNeighbors (p, [&] (Index q) { wider[p] = std::max (wider[p], values[q]); });
    });
    return wider;
  }

  // Largest displacement of each vertex: by the longest mean length of edges around it.
  std::vector<double> findReach () const
  {
    std::vector<double> reach (original.size (), 0.0);
    visit ([&] (Index p) {
      std::size_t neighbors = 0;
      visitNeighbors (p, [&] (Index q) {
        reach[p] += limits.farthest * (original[q] - original[p]).norm ();
        ++neighbors;
      });
      reach[p] /= static_cast<double> (neighbors);
    });
    for (int ring = 0; ring < limits.rings; ++ring)
      reach = widened (reach);
    return reach;
  }

  // The mean of the neighbours; at the boundary, of those along it. A vertex of one triangle would
  // get between these, and moves with them instead.
  Eigen::Vector3d targetOf (const std::vector<Eigen::Vector3d>& positions, Index p) const
  {
    const Eigen::Vector3d mean = rings.meanAround (mesh, positions, p);
    if (rings.before[p] == NONE || rings.leaving.row (p).size () > 1)
      return mean;
    return original[p] + mean - rings.meanAround (mesh, original, p);
  }
};

} // namespace

std::vector<Eigen::Vector3d>
smoothNoise (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const SmoothingLimits& limits, const RunContext& run)
{
  return Smoother{mesh, positions, limits, run}.smoothed ();
}

} // namespace pcl::floater
