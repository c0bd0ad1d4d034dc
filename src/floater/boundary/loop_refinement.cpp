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
// Nearest points of the loop whose edges are tried for a candidate.
constexpr std::size_t TRIED_LOOP_POINTS = 4;

double
distance (const std::vector<Eigen::Vector3d>& positions, Index p, Index q)
{
  return (positions[p] - positions[q]).norm ();
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

} // namespace

void
refineLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
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
}

} // namespace pcl::floater
