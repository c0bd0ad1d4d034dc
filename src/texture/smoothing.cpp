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

class Smoother
{
public:
  Smoother (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            const SmoothingLimits& limits, const RunContext& run)
      : mesh_ (mesh), positions_ (positions), limits_ (limits), run_ (run), rings_ (mesh),
        edge_bends_ (3 * mesh.triangles.size (), 0.0), bends_ (positions.size ())
  {
  }

  std::vector<Eigen::Vector3d> run ()
  {
    std::vector<Eigen::Vector3d> current = positions_;
    std::vector<std::uint8_t> is_noisy (positions_.size (), 1);
    measureBends (current, is_noisy);
    is_noisy = findNoise ();
    if (std::find (is_noisy.begin (), is_noisy.end (), 1) == is_noisy.end ())
      return current;
    for (int ring = 0; ring < limits_.rings; ++ring)
      is_noisy = withNeighbors (is_noisy);
    const std::vector<double> reach = findReach ();
    std::vector<Eigen::Vector3d> next = current;
    for (int round = 0; round < limits_.rounds; ++round) {
      measureBends (current, is_noisy);
      std::atomic<bool> has_moved{false};
      visit ([&] (Index p) {
        if (is_noisy[p] == 0 || !(bendsAround (p).bothWays () > limits_.smooth)) {
          next[p] = current[p];
          return;
        }
        const Eigen::Vector3d way = targetOf (current, p) - positions_[p];
        const double length = way.norm ();
        next[p] = positions_[p] + way * (length > reach[p] ? reach[p] / length : 1.0);
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
    parallelRanges (run_, positions_.size (), [&] (std::size_t first, std::size_t last) {
      for (std::size_t p = first; p < last; ++p)
        if (mesh_.triangle_of[p] != NONE)
          work (static_cast<Index> (p));
    });
  }

  // Calls work (q) for every neighbour of a vertex.
  template <typename Work>
  void visitNeighbors (Index p, const Work& work) const
  {
    for (const Index id : rings_.leaving.row (p))
      work (mesh_.to ({id / 3, static_cast<std::uint8_t> (id % 3)}));
    if (rings_.before[p] != NONE)
      work (rings_.before[p]);
  }

  // The angle between the normals at an edge: positive where the surface is convex.
  double bendAt (const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<Eigen::Vector3d>& area_vectors, MeshEdge edge) const
  {
    const Eigen::Vector3d& here = area_vectors[edge.triangle];
    const Eigen::Vector3d& beyond = area_vectors[mesh_.neighbors[edge.triangle][edge.side]];
    const Eigen::Vector3d along = positions[mesh_.to (edge)] - positions[mesh_.from (edge)];
    const Eigen::Vector3d turn = here.cross (beyond);
    const double angle = std::atan2 (turn.norm (), here.dot (beyond));
    return turn.dot (along) >= 0.0 ? angle : -angle;
  }

  // Sums the bends of marked vertices.
  void measureBends (const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<std::uint8_t>& is_marked)
  {
    const std::vector<Eigen::Vector3d> area_vectors = areaVectors (mesh_, positions, run_);
    parallelRanges (run_, mesh_.triangles.size (), [&] (std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t)
        for (std::uint8_t side = 0; side < 3; ++side) {
          const MeshEdge edge{static_cast<Index> (t), side};
          const MeshEdge mate = mesh_.mate (edge);
          if (mate.triangle == NONE || mate.triangle < edge.triangle ||
              (is_marked[mesh_.from (edge)] == 0 && is_marked[mesh_.to (edge)] == 0))
            continue;
          // Only this thread writes both.
          edge_bends_[3 * t + side] = edge_bends_[3 * std::size_t{mate.triangle} + mate.side] =
              bendAt (positions, area_vectors, edge);
        }
    });
    visit ([&] (Index p) {
      if (is_marked[p] == 0)
        return;
      Bends& bends = bends_[p] = {};
      for (const Index id : rings_.leaving.row (p)) {
        const double bend = edge_bends_[id];
        (bend > 0.0 ? bends.outwards : bends.inwards) += std::abs (bend);
        bends.edges += mesh_.neighbors[id / 3][id % 3] != NONE ? 1 : 0;
      }
    });
  }

  // A single peak bends one way only, so adjacent vertices count as well.
  Bends bendsAround (Index p) const
  {
    Bends sum = bends_[p];
    visitNeighbors (p, [&] (Index q) { sum.add (bends_[q]); });
    return sum;
  }

  std::vector<std::uint8_t> findNoise () const
  {
    std::vector<std::uint8_t> bends_both_ways (positions_.size (), 0);
    visit ([&] (Index p) {
      const Bends& own = bends_[p];
      if (own.outwards + own.inwards > limits_.bend * static_cast<double> (own.edges))
        bends_both_ways[p] = bendsAround (p).bothWays () > limits_.bend ? 1 : 0;
    });
    // Where creases of both kinds meet, only one vertex bends both ways.
    std::vector<std::uint8_t> is_noisy (positions_.size (), 0);
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

  std::vector<std::uint8_t> withNeighbors (const std::vector<std::uint8_t>& is_marked) const
  {
    std::vector<std::uint8_t> wider = is_marked;
    visit ([&] (Index p) { visitNeighbors (p, [&] (Index q) { wider[p] |= is_marked[q]; }); });
    return wider;
  }

  // Largest displacement of each vertex: by the longest mean length of edges around it.
  std::vector<double> findReach () const
  {
    std::vector<double> reach (positions_.size (), 0.0);
    visit ([&] (Index p) {
      std::size_t neighbors = 0;
      visitNeighbors (p, [&] (Index q) {
        reach[p] += limits_.farthest * (positions_[q] - positions_[p]).norm ();
        ++neighbors;
      });
      reach[p] /= static_cast<double> (neighbors);
    });
    for (int ring = 0; ring < limits_.rings; ++ring) {
      std::vector<double> wider = reach;
      visit ([&] (Index p) {
        visitNeighbors (p, [&] (Index q) { wider[p] = std::max (wider[p], reach[q]); });
      });
      reach.swap (wider);
    }
    return reach;
  }

  // The mean of the neighbours; at the boundary, of those along it. A vertex of one triangle would
  // get between these, and moves with them instead.
  Eigen::Vector3d targetOf (const std::vector<Eigen::Vector3d>& positions, Index p) const
  {
    const Eigen::Vector3d mean = rings_.meanAround (mesh_, positions, p);
    if (rings_.before[p] == NONE || rings_.leaving.row (p).size () > 1)
      return mean;
    return positions_[p] + mean - rings_.meanAround (mesh_, positions_, p);
  }

  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  const SmoothingLimits& limits_;
  const RunContext& run_;
  MeshRings rings_;
  std::vector<double> edge_bends_; // per edge, as 3 triangle + side; 0 on the boundary
  std::vector<Bends> bends_;       // per point
};

} // namespace

std::vector<Eigen::Vector3d>
smoothNoise (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const SmoothingLimits& limits, const RunContext& run)
{
  return Smoother (mesh, positions, limits, run).run ();
}

} // namespace pcl::floater
