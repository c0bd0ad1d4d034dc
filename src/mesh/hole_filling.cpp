// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/hole_filling.h"

#include "core/geometry.h"

#include <set>
#include <stdexcept>

namespace pcl::floater {
namespace {
using Edge = std::pair<Index, Index>; // the smaller point first

// Fills loops one by one. Edges of earlier fillings count as edges of the mesh.
class HoleFiller
{
public:
  HoleFiller (const TriangleMesh& mesh, const Positions& positions, const TriangleCost& cost,
              const HoleFillingLimits& limits, const RunContext& run,
              const std::function<bool (const Triangle&)>& fits)
      : mesh_ (mesh), positions_ (positions), cost_ (cost), limits_ (limits), run_ (run),
        fits_ (fits), filling_ (run)
  {
  }

  bool fill (const BoundaryLoop& loop)
  {
    // Around a component of one triangle, the only filling is that triangle, reversed.
    constexpr std::array<Index, 3> ALONE{NONE, NONE, NONE};
    if (mesh_.neighbors[mesh_.triangle_of[loop.points.front ()]] == ALONE)
      return false;
    std::vector<Index> polygon (loop.points.rbegin (), loop.points.rend ());
    const double step = loop.length / static_cast<double> (loop.points.size ());
    area_cost_ = limits_.area_cost / (step * step);
    std::vector<Triangle> triangles;
    std::set<Edge> ears; // edges that cut off an ear of this loop
    const auto allowed = [&] (Index p, Index q) {
      return !mesh_.hasEdge (p, q) && new_edges_.count (std::minmax (p, q)) == 0 &&
             ears.count (std::minmax (p, q)) == 0;
    };
    if (!cutEars (polygon, triangles, ears, allowed))
      return false;
    const std::vector<Triangle> rest = filling_.fill (
        polygon, [this] (Index p, Index q, Index r) { return fillCost (p, q, r); }, allowed,
        [this] (Index p, Index q, Index r) {
          return fits_ ({p, q, r});
        });
    if (rest.empty ())
      return false;
    triangles.insert (triangles.end (), rest.begin (), rest.end ());
    for (const Triangle& t : triangles)
      for (std::size_t i = 0; i < 3; ++i)
        new_edges_.insert (std::minmax (t[i], t[(i + 1) % 3]));
    filled_.insert (filled_.end (), triangles.begin (), triangles.end ());
    return true;
  }

  const std::vector<Triangle>& triangles () const { return filled_; }

private:
  double fillCost (Index p, Index q, Index r) const
  {
    const double double_area = areaVector (positions_[p], positions_[q], positions_[r]).norm ();
    return cost_ (p, q, r) + area_cost_ * double_area;
  }

  // Repeatedly cuts off the ear of least cost until the polygon is small enough. Returns false if
  // too few ears are allowed.
  template <typename Allowed>
  bool cutEars (std::vector<Index>& polygon, std::vector<Triangle>& triangles, std::set<Edge>& ears,
                Allowed&& allowed) const
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
      if (!allowed (polygon[a], polygon[b]) || !fits_ ({polygon[a], polygon[i], polygon[b]})) {
        queued[i] = -1.0; // not in the queue until an adjacent corner is cut off
        continue;
      }
      triangles.push_back ({polygon[a], polygon[i], polygon[b]});
      ears.insert (std::minmax (polygon[a], polygon[b]));
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
  const std::function<bool (const Triangle&)>& fits_;
  double area_cost_ = 0.0; // per unit of doubled area, for the current loop
  PolygonFilling filling_;
  std::vector<Triangle> filled_;
  std::set<Edge> new_edges_;
};

} // namespace

std::size_t
fillHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
           const TriangleCost& cost, const HoleFillingLimits& limits, const RunContext& run,
           const std::function<bool (const Triangle&)>& fits)
{
  HoleFiller filler (mesh, positions, cost, limits, run, fits);
  std::size_t filled = 0, done = 0;
  ProgressLoop progress (run, loops.size ());
  for (BoundaryLoop& loop : loops) {
    progress.reach (done++);
    if (loop.keep_open)
      continue;
    if (filler.fill (loop))
      ++filled;
    else
      loop.keep_open = true;
  }
  // Reserves exactly: growing would double the memory.
  mesh.triangles.reserve (mesh.triangles.size () + filler.triangles ().size ());
  mesh.triangles.insert (mesh.triangles.end (), filler.triangles ().begin (),
                         filler.triangles ().end ());
  if (filled > 0 && !mesh.connect (positions.size (), run))
    throw std::logic_error ("a hole was filled by triangles that do not fit");
  return filled;
}

} // namespace pcl::floater
