// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/hole_filling.h"

#include "mesh/box_tree.h"
#include "mesh/self_intersections.h"

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

// Whether triangles cross those of a mesh that are in a tree. Each loop has a copy of its own.
struct Obstacles
{
  const std::vector<Triangle>& triangles;
  const Positions& positions;
  const BoxTree& tree;
  const std::vector<Index>& loop_of;   // of each point, or NONE
  std::vector<std::size_t> found = {}; // the latest first

  bool cross (const Triangle& triangle, bool at_no_loop = false)
  {
    const Eigen::AlignedBox3d box = boxOf (triangle, positions);
    const auto isInTheWay = [&] (std::size_t t) {
      const Triangle& other = triangles[t];
      return box.intersects (boxOf (other, positions)) &&
             !(at_no_loop && anyCorner (other, [&] (Index p) { return loop_of[p] != NONE; })) &&
             doCross (triangle, other, positions);
    };
    const auto again = std::find_if (found.begin (), found.end (), isInTheWay);
    if (again != found.end ()) {
      std::rotate (found.begin (), again, again + 1);
      return true;
    }
    return tree.forOverlaps (box, [&] (std::size_t t) {
      if (!isInTheWay (t))
        return false;
      found.resize (std::min (found.size (), KEPT - 1));
      found.insert (found.begin (), t);
      return true;
    });
  }

  // The triangles of a loop have mostly the same ones in their way.
  static constexpr std::size_t KEPT = 16;
};

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

TriangleMesh
refillCrossed (const std::vector<Triangle>& filled, std::size_t before,
               std::vector<BoundaryLoop>& loops, Flags& is_chosen, bool may_stay_open,
               const Positions& positions, const TriangleCost& cost, const RunContext& run)
{
  std::vector<Index> loop_of (positions.size (), NONE);
  Flags is_asked (loops.size (), 0), is_pierced = is_asked, is_kept = is_asked;
  for (Index i = 0; i < loops.size (); ++i)
    for (const Index p : loops[i].points) {
      loop_of[p] = i;
      is_asked[i] |= is_chosen[p];
    }
  const BoxTree tree (
      before, [&] (std::size_t t) { return boxOf (filled[t], positions); }, run);
  Obstacles obstacles{filled, positions, tree, loop_of};
  std::vector<BoundaryLoop> crossed = loops;
  for (BoundaryLoop& loop : crossed)
    loop.keep_open = true;
  for (std::size_t t = before; t < filled.size (); ++t) {
    run.poll ();
    const Index i = loop_of[filled[t][0]];
    if (is_asked[i] == 0 || !obstacles.cross (filled[t]))
      continue;
    crossed[i].keep_open = false;
    if (is_pierced[i] == 0 && obstacles.cross (filled[t], true))
      is_pierced[i] = 1;
  }
  for (std::size_t i = 0; i < loops.size (); ++i)
    is_asked[i] = crossed[i].keep_open ? 0 : 1;
  // The mesh with the first fillings of chosen loops, or of those that are not.
  TriangleMesh mesh;
  mesh.triangles.assign (filled.begin (), filled.begin () + static_cast<std::ptrdiff_t> (before));
  const auto addFirst = [&] (const Flags& of_loop, std::uint8_t value) {
    for (std::size_t t = before; t < filled.size (); ++t)
      if (of_loop[loop_of[filled[t][0]]] == value)
        mesh.triangles.push_back (filled[t]);
    return mesh.connect (positions.size (), run);
  };
  addFirst (is_asked, 0);
  fillHoles (mesh, crossed, positions, cost, run,
             [obstacles] (const Triangle& t) mutable { return !obstacles.cross (t); });
  for (std::size_t i = 0; i < loops.size (); ++i) {
    if (is_asked[i] == 0)
      continue;
    is_kept[i] = crossed[i].keep_open && !(may_stay_open && is_pierced[i] != 0) ? 1 : 0;
    is_asked[i] -= is_kept[i];
    loops[i].keep_open = loops[i].judgement.is_too_deep = is_asked[i] != 0 && crossed[i].keep_open;
  }
  for (std::size_t p = 0; p < is_chosen.size (); ++p)
    is_chosen[p] = loop_of[p] != NONE ? is_asked[loop_of[p]] : 0;
  const bool is_other = std::find (is_asked.begin (), is_asked.end (), 1) != is_asked.end ();
  return is_other && addFirst (is_kept, 1) ? mesh : TriangleMesh ();
}

} // namespace pcl::floater
