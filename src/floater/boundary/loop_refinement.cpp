// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry.h"
#include "core/order_statistics.h"
#include "floater/boundary/boundary.h"
#include "points/kd_tree.h"

#include <algorithm>
#include <tuple>

namespace pcl::floater {
namespace {
// Largest number of steps along the loop between two edges that 2-opt exchanges. A longer reversal
// does not undo a crossing of neighbouring jags, and the time grows with the window.
constexpr std::size_t WINDOW = 30;
constexpr int UNTANGLE_PASSES = 10; // each only if the last one changed something
constexpr int INSERTION_PASSES = 4; // a candidate may lie beyond an edge to one just inserted
// Nearest points of the loop whose edges are tried for a candidate.
constexpr std::size_t TRIED_LOOP_POINTS = 4;

double
distance (const std::vector<Eigen::Vector3d>& positions, Index p, Index q)
{
  return (positions[p] - positions[q]).norm ();
}

// 2-opt: reverses stretches of the loop while that shortens it.
void
untangle (const std::vector<Eigen::Vector3d>& positions, std::vector<Index>& loop,
          const RunContext& run)
{
  ProgressLoop progress (run);
  const std::size_t n = loop.size ();
  const std::size_t window = std::min (WINDOW, n - 2);
  const auto at = [&] (std::size_t i) -> Index& { return loop[i % n]; };
  bool changed = n > 4;
  for (int pass = 0; changed && pass < UNTANGLE_PASSES; ++pass) {
    changed = false;
    for (std::size_t i = 0; i < n; ++i) {
      progress.next ();
      for (std::size_t j = i + 2; j <= i + window; ++j) {
        // Edges (i, i + 1) and (j, j + 1) become (i, j) and (i + 1, j + 1).
        if ((j + 1) % n == i)
          continue;
        const double now =
            distance (positions, at (i), at (i + 1)) + distance (positions, at (j), at (j + 1));
        const double then =
            distance (positions, at (i), at (j)) + distance (positions, at (i + 1), at (j + 1));
        if (then < now * (1.0 - 1e-9)) {
          for (std::size_t a = i + 1, b = j; a < b; ++a, --b)
            std::swap (at (a), at (b));
          changed = true;
        }
      }
    }
  }
}

// The direction from each edge of the loop to the surface, of length 1. The normals of the loop's
// points are oriented one after the other. Then the edges vote whether the neighbours of their
// points lie to the left or to the right.
std::vector<Eigen::Vector3d>
inwardDirections (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                  const std::vector<Index>& loop)
{
  std::vector<Eigen::Vector3d> inward;
  inward.reserve (loop.size ());
  Eigen::Vector3d previous = stars.normals[loop.front ()].cast<double> ();
  double vote = 0.0;
  for (std::size_t i = 0; i < loop.size (); ++i) {
    const Index a = loop[i], b = loop[(i + 1) % loop.size ()];
    Eigen::Vector3d normal = stars.normals[a].cast<double> ();
    if (normal.dot (previous) < 0.0)
      normal = -normal;
    previous = normal;
    inward.push_back (normal.cross (positions[b] - positions[a]).normalized ());
    for (const Index q : stars.neighbors.row (a)) {
      const Eigen::Vector3d offset = positions[q] - positions[a];
      vote += inward.back ().dot (offset) / offset.norm ();
    }
  }
  if (vote < 0.0)
    for (Eigen::Vector3d& direction : inward)
      direction = -direction;
  return inward;
}

// Inserts candidates that lie on or beyond an edge of the loop.
// \return number of insertions
std::size_t
insertBeyond (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
              const std::vector<float>& spacing, const std::vector<Index>& candidates,
              std::vector<Index>& loop, const RunContext& run, const LoopLimits& limits)
{
  const std::vector<Eigen::Vector3d> inward = inwardDirections (positions, stars, loop);
  std::vector<std::uint8_t> on_loop (positions.size (), 0);
  for (const Index p : loop)
    on_loop[p] = 1;
  const KdTree tree (valuesAt (positions, loop), run);
  struct Insertion
  {
    std::size_t after; // index in the loop
    double along;      // position along the edge: several points may go to one edge
    Index point;
  };
  std::vector<Insertion> insertions;
  std::vector<Neighbor> found;
  ProgressLoop progress (run);
  for (Index c : candidates) {
    progress.next ();
    if (on_loop[c] != 0)
      continue;
    tree.nearest (positions[c], TRIED_LOOP_POINTS, found);
    double smallest = limits.largest_detour * spacing[c];
    Insertion best{0, 0.0, NONE};
    for (const Neighbor& neighbor : found)
      for (const std::size_t i :
           {std::size_t{neighbor.point}, (neighbor.point + loop.size () - 1) % loop.size ()}) {
        const Index a = loop[i], b = loop[(i + 1) % loop.size ()];
        const double edge = distance (positions, a, b);
        const double detour = distance (positions, a, c) + distance (positions, c, b) - edge;
        if (detour >= smallest)
          continue;
        smallest = detour;
        const Eigen::Vector3d offset = positions[c] - positions[a];
        const bool beyond = inward[i].dot (offset) < limits.edge_margin * edge;
        best = {i, offset.dot (positions[b] - positions[a]), beyond ? c : NONE};
      }
    if (best.point != NONE)
      insertions.push_back (best);
  }
  std::sort (insertions.begin (), insertions.end (), [] (const Insertion& x, const Insertion& y) {
    return std::tie (x.after, x.along, x.point) < std::tie (y.after, y.along, y.point);
  });
  std::vector<Index> wider;
  auto next = insertions.begin ();
  for (std::size_t i = 0; i < loop.size (); ++i) {
    wider.push_back (loop[i]);
    for (; next != insertions.end () && next->after == i; ++next)
      wider.push_back (next->point);
  }
  loop = std::move (wider);
  return insertions.size ();
}

} // namespace

void
refineLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
            const std::vector<float>& spacing, const std::vector<Index>& candidates,
            std::vector<Index>& loop, const RunContext& run, const LoopLimits& limits)
{
  untangle (positions, loop, run);
  for (int pass = 0; pass < INSERTION_PASSES &&
                     insertBeyond (positions, stars, spacing, candidates, loop, run, limits) > 0;
       ++pass)
    untangle (positions, loop, run);
}

} // namespace pcl::floater
