// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/rim_filling.h"

#include "triangulation/polygon_filling.h"

#include <algorithm>
#include <set>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t LARGEST_POLYGON = 128; // for which the best triangulation is searched

using Edge = std::pair<Index, Index>;

Edge
edgeOf (Index p, Index q)
{
  return {std::min (p, q), std::max (p, q)};
}

// Fills one rim after the other; chords of earlier fillings are edges, too.
class RimFiller
{
public:
  RimFiller (const SurfaceMesh& mesh, const TriangleCost& cost) : mesh_ (mesh), cost_ (cost) {}

  bool fill (const Rim& rim)
  {
    std::vector<Index> polygon (rim.points.rbegin (), rim.points.rend ());
    std::vector<Triangle> triangles;
    std::set<Edge> ears; // chords cut off in this rim
    const auto allowed = [&] (Index p, Index q) {
      return !mesh_.hasEdge (p, q) && chords_.count (edgeOf (p, q)) == 0 &&
             ears.count (edgeOf (p, q)) == 0;
    };
    if (!cutEars (polygon, triangles, ears, allowed))
      return false;
    const std::vector<Triangle> rest = filling_.fill (polygon, cost_, allowed);
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
      return cost_ (polygon[before[i]], polygon[i], polygon[after[i]]);
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

  const SurfaceMesh& mesh_;
  const TriangleCost& cost_;
  PolygonFilling filling_;
  std::vector<Triangle> filled_;
  std::set<Edge> chords_;
};

} // namespace

std::size_t
fillRims (SurfaceMesh& mesh, std::vector<Rim>& rims, const TriangleCost& cost)
{
  RimFiller filler (mesh, cost);
  std::size_t filled = 0;
  for (Rim& rim : rims) {
    if (rim.stays)
      continue;
    if (filler.fill (rim))
      ++filled;
    else
      rim.stays = true;
  }
  mesh.triangles.insert (mesh.triangles.end (), filler.triangles ().begin (),
                         filler.triangles ().end ());
  mesh.connect (mesh.triangle_of.size ());
  return filled;
}

} // namespace floater
} // namespace pcl
