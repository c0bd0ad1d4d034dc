// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/hole_filling.h"

#include "core/geometry.h"
#include "core/order_statistics.h"

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
              const HoleFillingLimits& limits, const RunContext& run)
      : mesh_ (mesh), positions_ (positions), cost_ (cost), limits_ (limits), run_ (run),
        filling_ (run)
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
        polygon, [this] (Index p, Index q, Index r) { return fillCost (p, q, r); }, allowed);
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

  // Cuts off ears until the polygon is small enough: in each round the cheapest of them, none beside
  // another. Returns false if too few ears are allowed.
  template <typename Allowed>
  bool cutEars (std::vector<Index>& polygon, std::vector<Triangle>& triangles, std::set<Edge>& ears,
                Allowed&& allowed) const
  {
    // Nearly as if only the cheapest was cut each time. With 4, a third more pairs of triangles cross
    // in an airborne scan.
    constexpr std::size_t SHARE = 32;
    ProgressLoop progress (run_);
    while (polygon.size () > limits_.largest_polygon) {
      const std::size_t count = polygon.size (),
                        most = std::min (count - limits_.largest_polygon, count / SHARE + 1);
      std::vector<std::pair<double, std::size_t>> order;
      for (std::size_t i = 0; i < count; ++i) {
        progress.next ();
        order.emplace_back (
            fillCost (polygon[(i + count - 1) % count], polygon[i], polygon[(i + 1) % count]), i);
      }
      std::sort (order.begin (), order.end ());
      Flags stays (count, 0);
      std::vector<std::size_t> cut;
      for (const auto& [cost, i] : order) {
        const std::size_t before = (i + count - 1) % count, after = (i + 1) % count;
        const Index a = polygon[before], b = polygon[after];
        if (cut.size () == most || stays[i] != 0 || !allowed (a, b))
          continue;
        triangles.push_back ({a, polygon[i], b});
        ears.insert (std::minmax (a, b));
        stays[before] = stays[after] = 1;
        cut.push_back (i);
      }
      if (cut.empty ())
        return false;
      std::sort (cut.begin (), cut.end ());
      eraseRows (polygon, cut);
    }
    return true;
  }

  const TriangleMesh& mesh_;
  const Positions& positions_;
  const TriangleCost& cost_;
  HoleFillingLimits limits_;
  RunContext run_;
  double area_cost_ = 0.0; // per unit of doubled area, for the current loop
  PolygonFilling filling_;
  std::vector<Triangle> filled_;
  std::set<Edge> new_edges_;
};

} // namespace

std::size_t
fillHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
           const TriangleCost& cost, const HoleFillingLimits& limits, const RunContext& run)
{
  HoleFiller filler (mesh, positions, cost, limits, run);
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
