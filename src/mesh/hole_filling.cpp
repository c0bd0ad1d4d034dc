// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/hole_filling.h"

#include "core/parallel.h"

#include <set>

namespace pcl::floater {
namespace {
// Repeatedly cuts off the ear of least cost until the polygon is small enough for PolygonFilling,
// whose time grows with the third power.
// \param mayCut (p, q, r): whether a triangle and the edge from p to r are allowed
// \return false if too few ears are allowed
template <typename Cost, typename MayCut>
bool
cutEars (std::vector<Index>& polygon, std::vector<Triangle>& triangles, const Cost& cost,
         const MayCut& mayCut, const RunContext& run)
{
  constexpr std::size_t LARGEST_POLYGON = 128;
  if (polygon.size () <= LARGEST_POLYGON)
    return true;
  const auto count = static_cast<Index> (polygon.size ());
  std::vector<Index> before (count), after (count);
  for (Index i = 0; i < count; ++i) {
    before[i] = i == 0 ? count - 1 : i - 1;
    after[i] = i + 1 == count ? 0 : i + 1;
  }
  const auto earCost = [&] (Index i) {
    return cost (polygon[before[i]], polygon[i], polygon[after[i]]);
  };
  std::set<std::pair<double, Index>> queue;
  std::vector<double> queued (count);
  ProgressLoop progress (run);
  for (Index i = 0; i < count; ++i) {
    progress.next ();
    queue.emplace (queued[i] = earCost (i), i);
  }
  std::size_t left = count;
  while (left > LARGEST_POLYGON && !queue.empty ()) {
    progress.next ();
    const Index i = queue.begin ()->second;
    queue.erase (queue.begin ());
    const Index a = before[i], b = after[i];
    if (!mayCut (polygon[a], polygon[i], polygon[b])) {
      queued[i] = -1.0; // not in the queue until an adjacent corner is cut off
      continue;
    }
    triangles.push_back ({polygon[a], polygon[i], polygon[b]});
    after[a] = b;
    before[b] = a;
    after[i] = NONE;
    --left;
    for (Index j : {a, b}) {
      queue.erase ({queued[j], j});
      queue.emplace (queued[j] = earCost (j), j);
    }
  }
  std::vector<Index> rest;
  for (Index i = 0; i < count; ++i)
    if (after[i] != NONE)
      rest.push_back (polygon[i]);
  polygon.swap (rest);
  return polygon.size () <= LARGEST_POLYGON;
}

// The filling of a loop; empty if there is none.
std::vector<Triangle>
fillLoop (const BoundaryLoop& loop, const TriangleMesh& mesh, const Positions& positions,
          const TriangleCost& triangle_cost, std::function<bool (const Triangle&)> fits, // a copy
          const RunContext& run)
{
  // Around a component of one triangle, the only filling is that triangle, reversed.
  constexpr std::array<Index, 3> ALONE{NONE, NONE, NONE};
  if (mesh.neighbors[mesh.triangle_of[loop.points.front ()]] == ALONE)
    return {};
  std::vector<Index> polygon (loop.points.rbegin (), loop.points.rend ());
  const auto cost = fillingCost (triangle_cost, positions,
                                 loop.length / static_cast<double> (loop.points.size ()));
  std::vector<Triangle> triangles;
  if (!cutEars (
          polygon, triangles, cost,
          [&] (Index p, Index q, Index r) {
            return !mesh.hasEdge (p, r) && fits ({p, q, r});
          },
          run))
    return {};
  const std::vector<Triangle> rest = PolygonFilling (run).fill (
      polygon, cost, [&] (Index p, Index q) { return !mesh.hasEdge (p, q); },
      [&] (Index p, Index q, Index r) {
        return fits ({p, q, r});
      });
  if (rest.empty ())
    return {};
  triangles.insert (triangles.end (), rest.begin (), rest.end ());
  return triangles;
}

} // namespace

std::size_t
fillHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
           const TriangleCost& cost, const RunContext& run,
           const std::function<bool (const Triangle&)>& fits)
{
  // A point is on one loop only, so fillings of several loops have no edge in common.
  std::vector<std::vector<Triangle>> fillings (loops.size ());
  parallelTasks (run, loops.size (), [&] (std::size_t i) {
    if (!loops[i].keep_open)
      fillings[i] = fillLoop (loops[i], mesh, positions, cost, fits, run.withThreads (1));
  });
  std::size_t filled = 0, added = 0;
  for (std::size_t i = 0; i < loops.size (); ++i) {
    loops[i].keep_open = fillings[i].empty ();
    filled += fillings[i].empty () ? 0 : 1;
    added += fillings[i].size ();
  }
  // Reserves exactly: growing would double the memory.
  mesh.triangles.reserve (mesh.triangles.size () + added);
  for (const std::vector<Triangle>& filling : fillings)
    mesh.triangles.insert (mesh.triangles.end (), filling.begin (), filling.end ());
  if (filled > 0 && !mesh.connect (positions.size (), run))
    throw std::logic_error ("a hole was filled by triangles that do not fit");
  return filled;
}

} // namespace pcl::floater
