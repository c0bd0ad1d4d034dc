// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/hole_filling.h"

#include "core/geometry.h"
#include "core/parallel.h"

#include <set>
#include <stdexcept>

namespace pcl::floater {
namespace {
// Fills one loop.
class HoleFiller
{
public:
  HoleFiller (const TriangleMesh& mesh, const Positions& positions, const TriangleCost& cost,
              const HoleFillingLimits& limits, const RunContext& run,
              std::function<bool (const Triangle&)> fits)
      : mesh_ (mesh), positions_ (positions), cost_ (cost), limits_ (limits), run_ (run),
        fits_ (std::move (fits))
  {
  }

  // \return empty if there is no filling
  std::vector<Triangle> fill (const BoundaryLoop& loop)
  {
    // Around a component of one triangle, the only filling is that triangle, reversed.
    constexpr std::array<Index, 3> ALONE{NONE, NONE, NONE};
    if (mesh_.neighbors[mesh_.triangle_of[loop.points.front ()]] == ALONE)
      return {};
    std::vector<Index> polygon (loop.points.rbegin (), loop.points.rend ());
    const double step = loop.length / static_cast<double> (loop.points.size ());
    area_cost_ = limits_.area_cost / (step * step);
    std::vector<Triangle> triangles;
    if (!cutEars (polygon, triangles))
      return {};
    const std::vector<Triangle> rest = PolygonFilling (run_).fill (
        polygon, [this] (Index p, Index q, Index r) { return fillCost (p, q, r); },
        [this] (Index p, Index q) { return !mesh_.hasEdge (p, q); },
        [this] (Index p, Index q, Index r) {
          return fits_ ({p, q, r});
        });
    if (rest.empty ())
      return {};
    triangles.insert (triangles.end (), rest.begin (), rest.end ());
    return triangles;
  }

private:
  double fillCost (Index p, Index q, Index r) const
  {
    const double double_area = areaVector (positions_[p], positions_[q], positions_[r]).norm ();
    return cost_ (p, q, r).cost + area_cost_ * double_area;
  }

  // Repeatedly cuts off the ear of least cost until the polygon is small enough. Returns false if
  // too few ears are allowed.
  bool cutEars (std::vector<Index>& polygon, std::vector<Triangle>& triangles) const
  {
    if (polygon.size () <= limits_.largest_polygon)
      return true;
    const auto count = static_cast<Index> (polygon.size ());
    std::vector<Index> before (count), after (count);
    for (Index i = 0; i < count; ++i) {
      before[i] = i == 0 ? count - 1 : i - 1;
      after[i] = i + 1 == count ? 0 : i + 1;
    }
    const auto earCost = [&] (Index i) {
      return fillCost (polygon[before[i]], polygon[i], polygon[after[i]]);
    };
    std::set<std::pair<double, Index>> queue;
    std::vector<double> queued (count);
    ProgressLoop progress (run_);
    for (Index i = 0; i < count; ++i) {
      progress.next ();
      queue.emplace (queued[i] = earCost (i), i);
    }
    std::size_t left = count;
    while (left > limits_.largest_polygon && !queue.empty ()) {
      progress.next ();
      const Index i = queue.begin ()->second;
      queue.erase (queue.begin ());
      const Index a = before[i], b = after[i];
      if (mesh_.hasEdge (polygon[a], polygon[b]) || !fits_ ({polygon[a], polygon[i], polygon[b]})) {
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
    return polygon.size () <= limits_.largest_polygon;
  }

  const TriangleMesh& mesh_;
  const Positions& positions_;
  const TriangleCost& cost_;
  HoleFillingLimits limits_;
  RunContext run_;
  std::function<bool (const Triangle&)> fits_;
  double area_cost_ = 0.0; // per unit of doubled area
};

} // namespace

std::size_t
fillHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
           const TriangleCost& cost, const HoleFillingLimits& limits, const RunContext& run,
           const std::function<bool (const Triangle&)>& fits)
{
  // A point is on one loop only, so fillings of several loops have no edge in common.
  std::vector<std::vector<Triangle>> fillings (loops.size ());
  parallelTasks (run, loops.size (), [&] (std::size_t i) {
    if (!loops[i].keep_open)
      fillings[i] =
          HoleFiller (mesh, positions, cost, limits, run.withThreads (1), fits).fill (loops[i]);
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
