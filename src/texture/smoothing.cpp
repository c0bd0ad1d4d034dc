// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/smoothing.h"

#include "core/parallel.h"
#include "texture/chart_mesh.h"
#include "texture/charts.h"

#include <atomic>

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
  const Positions& original; // positions
  const SmoothingLimits& limits;
  const RunContext& run;
  MeshRings rings{mesh};
  std::vector<Bends> bends_at{}; // per point

  Positions smoothed ()
  {
    bends_at.resize (original.size ());
    Positions current = original;
    Flags is_noisy (original.size (), 1);
    measureBends (current, is_noisy);
    is_noisy = findNoise ();
    if (std::find (is_noisy.begin (), is_noisy.end (), 1) == is_noisy.end ())
      return current;
    widen (is_noisy);
    const std::vector<double> reach = findReach ();
    Positions next = current;
    for (int round = 0; round < limits.rounds; ++round) {
      measureBends (current, is_noisy);
      std::atomic<bool> has_moved{false};
      visit ([&] (Index p) {
        if (is_noisy[p] == 0 || !(bendsAround (p).bothWays () > limits.smooth)) {
          next[p] = current[p];
          return;
        }
        const Vector3d way = targetOf (current, p) - original[p];
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

  // Sums the bends of marked vertices: the angles between the normals at their edges, outwards where
  // the surface is convex.
  void measureBends (const Positions& positions, const Flags& is_marked)
  {
    const std::vector<Vector3d> area_vectors = areaVectors (mesh, positions, run);
    visit ([&] (Index p) {
      if (is_marked[p] == 0)
        return;
      Bends& bends = bends_at[p] = {};
      for (const Index id : rings.leaving.row (p)) {
        const MeshEdge edge{id / 3, static_cast<std::uint8_t> (id % 3)};
        const Index other = mesh.neighbors[edge.triangle][edge.side];
        if (other == NONE)
          continue;
        const Vector3d &here = area_vectors[edge.triangle], &beyond = area_vectors[other];
        const Vector3d along = positions[mesh.to (edge)] - positions[mesh.from (edge)];
        const Vector3d turn = here.cross (beyond);
        (turn.dot (along) >= 0.0 ? bends.outwards : bends.inwards) +=
            std::atan2 (turn.norm (), here.dot (beyond));
        ++bends.edges;
      }
    });
  }

  // A single peak bends one way only, so adjacent vertices count as well.
  Bends bendsAround (Index p) const
  {
    Bends sum = bends_at[p];
    for (const Index q : rings.neighbors.row (p))
      sum.add (bends_at[q]);
    return sum;
  }

  Flags findNoise () const
  {
    Flags bends_both_ways (original.size (), 0);
    visit ([&] (Index p) {
      const Bends& own = bends_at[p];
      if (own.outwards + own.inwards > limits.bend * static_cast<double> (own.edges))
        bends_both_ways[p] = bendsAround (p).bothWays () > limits.bend ? 1 : 0;
    });
    // Where creases of both kinds meet, only one vertex bends both ways.
    Flags is_noisy (original.size (), 0);
    visit ([&] (Index p) {
      if (bends_both_ways[p] == 0)
        return;
      std::size_t beside = 0;
      for (const Index q : rings.neighbors.row (p))
        beside += bends_both_ways[q];
      is_noisy[p] = 2 * beside >= rings.neighbors.row (p).size () ? 1 : 0;
    });
    return is_noisy;
  }

  // Gives each vertex the largest value of those within some rings around it.
  template <typename Value>
  void widen (std::vector<Value>& values) const
  {
    for (int ring = 0; ring < limits.rings; ++ring) {
      const std::vector<Value> narrow = values;
      visit ([&] (Index p) {
        for (const Index q : rings.neighbors.row (p))
          values[p] = std::max (values[p], narrow[q]);
      });
    }
  }

  // Largest displacement of each vertex: by the longest mean length of edges around it.
  std::vector<double> findReach () const
  {
    std::vector<double> reach (original.size (), 0.0);
    visit ([&] (Index p) {
      for (const Index q : rings.neighbors.row (p))
        reach[p] += limits.farthest * (original[q] - original[p]).norm ();
      reach[p] /= static_cast<double> (rings.neighbors.row (p).size ());
    });
    widen (reach);
    return reach;
  }

  // The mean of the neighbours; at the boundary, of those along it. A vertex of one triangle would
  // get between these, and moves with them instead.
  Vector3d targetOf (const Positions& positions, Index p) const
  {
    const Vector3d mean = rings.meanAround (positions, p);
    if (rings.before[p] == NONE || rings.leaving.row (p).size () > 1)
      return mean;
    return original[p] + mean - rings.meanAround (original, p);
  }
};

} // namespace

Positions
smoothNoise (const TriangleMesh& mesh, const Positions& positions, const SmoothingLimits& limits,
             const RunContext& run)
{
  return Smoother{mesh, positions, limits, run}.smoothed ();
}

} // namespace pcl::floater
