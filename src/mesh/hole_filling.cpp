// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/hole_filling.h"

#include "mesh/polygon_filling.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t LARGEST_POLYGON = 128; // for which the best triangulation is searched

constexpr double AREA_COST =
    200.0; // of twice the square of the rim's step; a right isosceles triangle costs 2

using Edge = std::pair<Index, Index>;

Edge
edgeOf (Index p, Index q)
{
  return {std::min (p, q), std::max (p, q)};
}

// Fills one rim after the other; chords of earlier fillings are edges, too.
class HoleFiller
{
public:
  HoleFiller (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const TriangleCost& cost)
      : mesh_ (mesh), positions_ (positions), cost_ (cost)
  {
  }

  bool fill (const BoundaryLoop& loop)
  {
    std::vector<Index> polygon (loop.points.rbegin (), loop.points.rend ());
    const double step = loop.length / static_cast<double> (loop.points.size ());
    area_cost_ = AREA_COST / (step * step);
    std::vector<Triangle> triangles;
    std::set<Edge> ears; // chords cut off in this rim
    const auto allowed = [&] (Index p, Index q) {
      return !mesh_.hasEdge (p, q) && chords_.count (edgeOf (p, q)) == 0 &&
             ears.count (edgeOf (p, q)) == 0;
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
        chords_.insert (edgeOf (t[i], t[(i + 1) % 3]));
    filled_.insert (filled_.end (), triangles.begin (), triangles.end ());
    return true;
  }

  const std::vector<Triangle>& triangles () const { return filled_; }

private:
  // Sheets that end face to face are to be joined across the narrow gap between them, not each
  // closed over its opening: area counts.
  double fillCost (Index p, Index q, Index r) const
  {
    const Eigen::Vector3d area_vector =
        (positions_[q] - positions_[p]).cross (positions_[r] - positions_[p]);
    return cost_ (p, q, r) + area_cost_ * area_vector.norm ();
  }

  // Cuts the ears of least cost until the polygon is small.
  template <typename Allowed>
  bool cutEars (std::vector<Index>& polygon, std::vector<Triangle>& triangles, std::set<Edge>& ears,
                Allowed&& allowed) const
  {
    if (polygon.size () <= LARGEST_POLYGON)
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
    for (Index i = 0; i < count; ++i)
      queue.emplace (queued[i] = earCost (i), i);
    std::size_t left = count;
    while (left > LARGEST_POLYGON && !queue.empty ()) {
      const Index i = queue.begin ()->second;
      queue.erase (queue.begin ());
      const Index a = before[i], b = after[i];
      if (!allowed (polygon[a], polygon[b])) {
        queued[i] = -1.0; // until a neighbour goes
        continue;
      }
      triangles.push_back ({polygon[a], polygon[i], polygon[b]});
      ears.insert (edgeOf (polygon[a], polygon[b]));
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

  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  const TriangleCost& cost_;
  double area_cost_ = 0.0; // per unit of doubled area, for the rim at hand
  PolygonFilling filling_;
  std::vector<Triangle> filled_;
  std::set<Edge> chords_;
};

} // namespace

std::size_t
fillHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops,
           const std::vector<Eigen::Vector3d>& positions, const TriangleCost& cost,
           const RunContext& run)
{
  HoleFiller filler (mesh, positions, cost);
  std::size_t filled = 0;
  for (BoundaryLoop& loop : loops) {
    if (loop.keep_open)
      continue;
    if (filler.fill (loop))
      ++filled;
    else
      loop.keep_open = true;
  }
  mesh.triangles.insert (mesh.triangles.end (), filler.triangles ().begin (),
                         filler.triangles ().end ());
  if (filler.triangles ().empty ())
    return filled;
  if (!mesh.connect (mesh.triangle_of.size (), run))
    throw std::logic_error ("a hole was filled by triangles that do not fit");
  return filled;
}

} // namespace floater
} // namespace pcl
