// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/neck_cutting.h"

#include "core/order_statistics.h"
#include "mesh/folds.h"

namespace pcl::floater {
namespace {
// What was reached since it was last cleared, in O(1).
class Marks
{
public:
  explicit Marks (std::size_t count) : mark_ (count, 0) {}

  void clear () { ++now_; }
  bool has (Index i) const { return i != NONE && mark_[i] == now_; }
  bool add (Index i) { return std::exchange (mark_[i], now_) != now_; }

private:
  std::vector<std::uint32_t> mark_;
  std::uint32_t now_ = 1;
};

struct NeckFinder
{
  using Edge = std::pair<Index, Index>;       // points, the smaller first
  using Rim = std::pair<Index, std::uint8_t>; // a triangle and its side

  struct Reached
  {
    Index point, before; // the visit before; NONE at the start
    std::size_t edges;   // from the start
  };

  const TriangleMesh& mesh;
  const Flags& is_boundary; // of each point
  std::size_t longest;
  std::size_t largest_cap =
      3 * longest * longest / 4; // triangles of a sphere that such a loop goes around
  // Triangles; and points, those of triangles that were taken.
  Marks is_taken{mesh.triangles.size ()}, is_reached = is_taken;
  Marks is_corner{mesh.triangle_of.size ()}, is_visited = is_corner;
  std::vector<Index> visit_of =
      std::vector<Index> (mesh.triangle_of.size (), NONE); // of each visited point
  std::vector<Reached> visits = {};                        // breadth first
  std::vector<Index> taken = {};
  long euler = 0;                           // characteristic of the triangles that were taken
  std::vector<std::vector<Rim>> sides = {}; // loops at which these end, not around caps
  std::vector<Edge> crossed = {};           // on a way of triangles between two sides
  std::vector<Index> cap = {}, fan = {}, ring = {}; // scratch

  // The shortest loop around a neck near a point; empty if there is none.
  std::vector<Index> loopNear (Index start)
  {
    for (Marks* marks : {&is_taken, &is_corner, &is_visited})
      marks->clear ();
    taken.clear ();
    visits.clear ();
    euler = 0;
    visit (start, NONE, 0);
    for (Index i = 0; i < visits.size () && 2 * visits[i].edges < longest; ++i) {
      if (!takeFan (i))
        return {};
      if (euler == 1)
        continue;
      findSides ();
      if (sides.size () > 1)
        return shortestLoop ();
      if (euler != 1)
        return {};
    }
    return {};
  }

  // \return false at the boundary
  bool visit (Index p, Index before, std::size_t edges)
  {
    if (is_visited.add (p)) {
      visit_of[p] = static_cast<Index> (visits.size ());
      visits.push_back ({p, before, edges});
    }
    return is_boundary[p] == 0;
  }

  bool takeFan (Index i)
  {
    const Reached from = visits[i];
    mesh.fan (from.point, fan, ring);
    std::for_each (fan.begin (), fan.end (), [this] (Index t) { take (t); });
    return is_boundary[from.point] == 0 && std::all_of (ring.begin (), ring.end (), [&] (Index p) {
             return visit (p, i, from.edges + 1);
           });
  }

  void take (Index t)
  {
    if (!is_taken.add (t))
      return;
    taken.push_back (t);
    euler -= 2;
    for (const Index u : mesh.neighbors[t])
      euler += is_taken.has (u) ? 1 : 0;
    for (const Index p : mesh.triangles[t])
      euler += is_corner.add (p) ? 1 : 0;
  }

  // The loops at which the triangles that were taken end. Caps beyond such loops are taken, too; one
  // with a hole leaves the Euler characteristic of the others.
  void findSides ()
  {
    sides.clear ();
    std::vector<Rim> rim;
    for (const Index t : taken)
      for (std::uint8_t side = 0; side < 3; ++side)
        if (!is_taken.has (mesh.neighbors[t][side]))
          rim.emplace_back (t, side);
    std::sort (rim.begin (), rim.end ());
    while (!rim.empty ()) {
      std::vector<Rim> side;
      cap.clear ();
      is_reached.clear ();
      for (Rim e = rim.back ();; e = nextOnRim (e)) {
        const auto at = std::lower_bound (rim.begin (), rim.end (), e);
        if (at == rim.end () || *at != e)
          break;
        rim.erase (at);
        side.push_back (e);
        addToCap (mesh.neighbors[e.first][e.second]);
      }
      for (std::size_t i = 0; i < cap.size () && cap.size () <= largest_cap; ++i)
        for (const Index t : mesh.neighbors[cap[i]])
          addToCap (t);
      if (cap.size () > largest_cap)
        sides.push_back (std::move (side));
      else
        std::for_each (cap.begin (), cap.end (), [this] (Index t) { take (t); });
    }
  }

  void addToCap (Index t)
  {
    if (t != NONE && !is_taken.has (t) && is_reached.add (t))
      cap.push_back (t);
  }

  // The next edge of the rim, around the triangles that were not taken.
  Rim nextOnRim (Rim e) const
  {
    MeshEdge next{e.first, e.second};
    do {
      const MeshEdge mate = mesh.mate (next);
      next = {mate.triangle, TriangleMesh::previous (mate.side)};
    } while (!is_taken.has (mesh.neighbors[next.triangle][next.side]));
    const MeshEdge mate = mesh.mate (next);
    return {mate.triangle, mate.side};
  }

  // A loop is between the two sides if it crosses a way of triangles from one to the other an odd
  // number of times.
  std::vector<Index> shortestLoop ()
  {
    markWay ();
    Flags is_odd (visits.size (), 0);
    for (std::size_t i = 1; i < visits.size (); ++i)
      is_odd[i] =
          is_odd[visits[i].before] ^ crossings (visits[i].point, visits[visits[i].before].point);
    std::size_t least = longest + 1;
    std::array<Index, 2> ends{NONE, NONE};
    for (const Index t : taken)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index p = mesh.from ({t, side}), q = mesh.to ({t, side});
        if (!is_visited.has (p) || !is_visited.has (q))
          continue;
        const Index i = visit_of[p], j = visit_of[q];
        const std::size_t edges = visits[i].edges + visits[j].edges + 1;
        if (edges < least && (is_odd[i] ^ is_odd[j] ^ crossings (p, q)) != 0) {
          least = edges;
          ends = {i, j};
        }
      }
    std::vector<Index> loop, back;
    if (least > longest)
      return loop;
    for (auto [i, j] = ends; i != j;) {
      Index& later = i > j ? i : j;
      (i > j ? loop : back).push_back (visits[later].point);
      later = visits[later].before;
      if (i == j)
        loop.push_back (visits[i].point);
    }
    loop.insert (loop.end (), back.rbegin (), back.rend ());
    return loop;
  }

  Edge edgeOf (MeshEdge e) const { return std::minmax (mesh.from (e), mesh.to (e)); }

  // The edges that a way of triangles crosses from beyond one side to beyond the other.
  void markWay ()
  {
    struct Step
    {
      Index triangle;
      Edge edge; // over which it was reached
      std::size_t before;
    };
    const auto edgeOfRim = [this] (Rim e) { return edgeOf ({e.first, e.second}); };
    const Rim start = sides[0].front ();
    std::sort (sides[1].begin (), sides[1].end ());
    std::vector<Step> steps{{start.first, edgeOfRim (start), 0}};
    is_reached.clear ();
    is_reached.add (start.first);
    crossed.clear ();
    for (std::size_t i = 0; i < steps.size () && crossed.empty (); ++i) {
      const Index t = steps[i].triangle;
      const auto end = std::lower_bound (sides[1].begin (), sides[1].end (), Rim{t, 0});
      if (end != sides[1].end () && end->first == t) {
        crossed = {edgeOfRim (*end), edgeOfRim (start)};
        for (std::size_t k = i; k > 0; k = steps[k].before)
          crossed.push_back (steps[k].edge);
      }
      for (std::uint8_t side = 0; side < 3; ++side)
        if (const Index u = mesh.neighbors[t][side]; is_taken.has (u) && is_reached.add (u))
          steps.push_back ({u, edgeOf ({t, side}), i});
    }
  }

  std::uint8_t crossings (Index p, Index q) const
  {
    const Edge edge = std::minmax (p, q);
    return std::find (crossed.begin (), crossed.end (), edge) != crossed.end () ? 1 : 0;
  }
};

} // namespace

std::vector<std::vector<Index>>
findNeckLoops (const TriangleMesh& mesh, const Positions& positions, const Flags& is_skipped,
               std::size_t longest, const RunContext& run)
{
  std::vector<std::vector<Index>> found;
  std::vector<Index> starts;
  for (const MeshEdge e : findFolds (mesh, positions, run, isBent))
    starts.insert (starts.end (), {mesh.from (e), mesh.to (e)});
  sortUnique (starts);
  if (starts.empty ())
    return found;
  const Flags is_boundary = boundaryPoints (mesh);
  NeckFinder finder{mesh, is_boundary, longest};
  Flags is_searched = is_skipped;
  is_searched.resize (positions.size (), 0);
  ProgressLoop progress (run, starts.size ());
  for (const Index p : starts) {
    progress.next ();
    if (is_searched[p] != 0)
      continue;
    std::vector<Index> loop = finder.loopNear (p);
    for (std::size_t i = 0; i < finder.visits.size () && finder.visits[i].edges <= 1; ++i)
      is_searched[finder.visits[i].point] = 1;
    if (!loop.empty ()) {
      // From the smallest point, towards the smaller one beside it.
      std::rotate (loop.begin (), std::min_element (loop.begin (), loop.end ()), loop.end ());
      if (loop.back () < loop[1])
        std::reverse (loop.begin () + 1, loop.end ());
      found.push_back (std::move (loop));
    }
  }
  std::sort (found.begin (), found.end (), [] (const auto& a, const auto& b) {
    return a.size () != b.size () ? a.size () < b.size () : a < b;
  });
  found.erase (std::unique (found.begin (), found.end ()), found.end ());
  return found;
}

} // namespace pcl::floater
