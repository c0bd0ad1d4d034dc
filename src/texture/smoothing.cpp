// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parallel.h"
#include "texture/chart_mesh.h"
#include "texture/charts.h"

namespace pcl::floater {
namespace {
// Threshold in radians for the mean outward and the mean inward bend at the edges of a vertex and its
// neighbours: if both are above, the surface bends both ways. Bodies, however coarse, and creases bend
// one way. With angles that scatter by 20 degrees, as for noise of a tenth of the spacing, it is 0.14.
// A vertex is rough if it and half of its neighbours bend both ways.
constexpr double ROUGH = 0.14;

// Bend below which a vertex of noise is smooth. With it, noise as large as the spacing leaves normals
// of a plane that differ by 4 degrees between triangles, and by 6 from the plane (medians).
constexpr double SMOOTH = 0.06;

// Of vertices around rough ones that are smoothed, too: quantized depths are flat between steps.
constexpr int RINGS = 3;

constexpr int MOST_ROUNDS = 20; // noise as large as the spacing takes 10

// Largest displacement of a vertex, in mean lengths of the edges at the vertices around it, where
// these are longest: the largest noise that can be connected. Thin parts would shrink to lines.
constexpr double FARTHEST = 1.0;

// Angles at the edges of a vertex.
struct Bends
{
  double outwards = 0.0, inwards = 0.0; // sums
  std::size_t edges = 0;                // that are inside
};

} // namespace

Positions
smoothNoise (const TriangleMesh& mesh, const Positions& original, const RunContext& run)
{
  const MeshRings rings (mesh);
  std::vector<Bends> bends_at (original.size ());
  // Calls work (p) for every vertex.
  const auto visit = [&] (const auto& work) {
    parallelPoints (run, original.size (), [&] (Index p) {
      if (mesh.triangle_of[p] != NONE)
        work (p);
    });
  };
  // Sums the bends of marked vertices: angles between the normals at an edge, outwards if convex.
  const auto measureBends = [&] (const Positions& positions, const Flags& is_marked) {
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
  };
  // The smaller of both mean angles, with those beside: a single peak bends one way only.
  const auto bendBothWays = [&] (Index p) {
    Bends sum = bends_at[p];
    for (const Index q : rings.neighbors.row (p)) {
      sum.outwards += bends_at[q].outwards;
      sum.inwards += bends_at[q].inwards;
      sum.edges += bends_at[q].edges;
    }
    return sum.edges > 0 ? std::min (sum.outwards, sum.inwards) / static_cast<double> (sum.edges)
                         : 0.0;
  };
  // Gives each vertex the largest value of those within some rings around it.
  const auto widen = [&] (auto& values) {
    for (int ring = 0; ring < RINGS; ++ring) {
      const auto narrow = values;
      visit ([&] (Index p) {
        for (const Index q : rings.neighbors.row (p))
          values[p] = std::max (values[p], narrow[q]);
      });
    }
  };
  // A vertex of one triangle would get between its neighbours, and moves with them instead.
  const auto targetOf = [&] (const Positions& positions, Index p) -> Vector3d {
    const Vector3d mean = rings.meanAround (positions, p);
    if (rings.before[p] == NONE || rings.leaving.row (p).size () > 1)
      return mean;
    return original[p] + mean - rings.meanAround (original, p);
  };

  measureBends (original, Flags (original.size (), 1));
  Flags bends_both_ways (original.size (), 0), is_noisy = bends_both_ways;
  visit ([&] (Index p) {
    const Bends& own = bends_at[p];
    if (own.outwards + own.inwards > ROUGH * static_cast<double> (own.edges))
      bends_both_ways[p] = bendBothWays (p) > ROUGH ? 1 : 0;
  });
  // Where creases of both kinds meet, only one vertex bends both ways.
  visit ([&] (Index p) {
    if (bends_both_ways[p] == 0)
      return;
    std::size_t beside = 0;
    for (const Index q : rings.neighbors.row (p))
      beside += bends_both_ways[q];
    is_noisy[p] = 2 * beside >= rings.neighbors.row (p).size () ? 1 : 0;
  });
  if (std::find (is_noisy.begin (), is_noisy.end (), 1) == is_noisy.end ())
    return original;
  widen (is_noisy);
  // Largest displacement of each vertex: by the longest mean length of edges around it.
  std::vector<double> reach (original.size (), 0.0);
  visit ([&] (Index p) {
    for (const Index q : rings.neighbors.row (p))
      reach[p] += FARTHEST * (original[q] - original[p]).norm ();
    reach[p] /= static_cast<double> (rings.neighbors.row (p).size ());
  });
  widen (reach);
  Positions current = original, next = original;
  for (int round = 0; round < MOST_ROUNDS; ++round) {
    measureBends (current, is_noisy);
    std::atomic<bool> has_moved{false};
    visit ([&] (Index p) {
      if (is_noisy[p] == 0 || !(bendBothWays (p) > SMOOTH)) {
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

} // namespace pcl::floater
