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

class NeckFinder
{
public:
  // \param is_boundary of each point
  NeckFinder (const TriangleMesh& mesh, const Flags& is_boundary, std::size_t longest)
      : mesh_ (mesh), is_boundary_ (is_boundary), longest_ (longest),
        largest_cap_ (3 * longest * longest / 4), is_taken_ (mesh.triangles.size ()),
        is_reached_ (mesh.triangles.size ()), is_corner_ (mesh.triangle_of.size ()),
        is_visited_ (mesh.triangle_of.size ()), visit_of_ (mesh.triangle_of.size (), NONE)
  {
  }

  // The shortest loop around a neck near a point; empty if there is none.
  std::vector<Index> loopNear (Index start)
  {
    for (Marks* marks : {&is_taken_, &is_corner_, &is_visited_})
      marks->clear ();
    taken_.clear ();
    visits_.clear ();
    euler_ = 0;
    visit (start, NONE, 0);
    for (Index i = 0; i < visits_.size () && 2 * visits_[i].edges < longest_; ++i) {
      if (!takeFan (i))
        return {};
      if (euler_ == 1)
        continue;
      findSides ();
      if (sides_.size () > 1)
        return shortestLoop ();
      if (euler_ != 1)
        return {};
    }
    return {};
  }

  // The points that the last search has reached within some edges of its start.
  template <typename Visit>
  void forEachWithin (std::size_t edges, Visit&& visit) const
  {
    for (std::size_t i = 0; i < visits_.size () && visits_[i].edges <= edges; ++i)
      visit (visits_[i].point);
  }

private:
  using Edge = std::pair<Index, Index>;       // points, the smaller first
  using Rim = std::pair<Index, std::uint8_t>; // a triangle and its side

  struct Reached
  {
    Index point, before; // the visit before; NONE at the start
    std::size_t edges;   // from the start
  };

  // \return false at the boundary
  bool visit (Index p, Index before, std::size_t edges)
  {
    if (is_visited_.add (p)) {
      visit_of_[p] = static_cast<Index> (visits_.size ());
      visits_.push_back ({p, before, edges});
    }
    return is_boundary_[p] == 0;
  }

  bool takeFan (Index i)
  {
    const Reached from = visits_[i];
    mesh_.fan (from.point, fan_, ring_);
    std::for_each (fan_.begin (), fan_.end (), [this] (Index t) { take (t); });
    return is_boundary_[from.point] == 0 &&
           std::all_of (ring_.begin (), ring_.end (),
                        [&] (Index p) { return visit (p, i, from.edges + 1); });
  }

  void take (Index t)
  {
    if (!is_taken_.add (t))
      return;
    taken_.push_back (t);
    euler_ -= 2;
    for (const Index u : mesh_.neighbors[t])
      euler_ += is_taken_.has (u) ? 1 : 0;
    for (const Index p : mesh_.triangles[t])
      euler_ += is_corner_.add (p) ? 1 : 0;
  }

  // The loops at which the triangles that were taken end. Caps beyond such loops are taken, too; one
  // with a hole leaves the Euler characteristic of the others.
  void findSides ()
  {
    sides_.clear ();
    std::vector<Rim> rim;
    for (const Index t : taken_)
      for (std::uint8_t side = 0; side < 3; ++side)
        if (!is_taken_.has (mesh_.neighbors[t][side]))
          rim.emplace_back (t, side);
    std::sort (rim.begin (), rim.end ());
    while (!rim.empty ()) {
      std::vector<Rim> side;
      cap_.clear ();
      is_reached_.clear ();
      for (Rim e = rim.back ();; e = nextOnRim (e)) {
        const auto at = std::lower_bound (rim.begin (), rim.end (), e);
        if (at == rim.end () || *at != e)
          break;
        rim.erase (at);
        side.push_back (e);
        addToCap (mesh_.neighbors[e.first][e.second]);
      }
      for (std::size_t i = 0; i < cap_.size () && cap_.size () <= largest_cap_; ++i)
        for (const Index t : mesh_.neighbors[cap_[i]])
          addToCap (t);
      if (cap_.size () > largest_cap_)
        sides_.push_back (std::move (side));
      else
        std::for_each (cap_.begin (), cap_.end (), [this] (Index t) { take (t); });
    }
  }

  void addToCap (Index t)
  {
    if (t != NONE && !is_taken_.has (t) && is_reached_.add (t))
      cap_.push_back (t);
  }

  // The next edge of the rim, around the triangles that were not taken.
  Rim nextOnRim (Rim e) const
  {
    MeshEdge next{e.first, e.second};
    do {
      const MeshEdge mate = mesh_.mate (next);
      next = {mate.triangle, TriangleMesh::previous (mate.side)};
    } while (!is_taken_.has (mesh_.neighbors[next.triangle][next.side]));
    const MeshEdge mate = mesh_.mate (next);
    return {mate.triangle, mate.side};
  }

  // A loop is between the two sides if it crosses a way of triangles from one to the other an odd
  // number of times.
  std::vector<Index> shortestLoop ()
  {
    markWay ();
    Flags is_odd (visits_.size (), 0);
    for (std::size_t i = 1; i < visits_.size (); ++i)
      is_odd[i] = is_odd[visits_[i].before] ^
                  crossings (visits_[i].point, visits_[visits_[i].before].point);
    std::size_t least = longest_ + 1;
    std::array<Index, 2> ends{NONE, NONE};
    for (const Index t : taken_)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index p = mesh_.from ({t, side}), q = mesh_.to ({t, side});
        if (!is_visited_.has (p) || !is_visited_.has (q))
          continue;
        const Index i = visit_of_[p], j = visit_of_[q];
        const std::size_t edges = visits_[i].edges + visits_[j].edges + 1;
        if (edges < least && (is_odd[i] ^ is_odd[j] ^ crossings (p, q)) != 0) {
          least = edges;
          ends = {i, j};
        }
      }
    std::vector<Index> loop, back;
    if (least > longest_)
      return loop;
    for (auto [i, j] = ends; i != j;) {
      Index& later = i > j ? i : j;
      (i > j ? loop : back).push_back (visits_[later].point);
      later = visits_[later].before;
      if (i == j)
        loop.push_back (visits_[i].point);
    }
    loop.insert (loop.end (), back.rbegin (), back.rend ());
    return loop;
  }

  Edge edgeOf (MeshEdge e) const { return std::minmax (mesh_.from (e), mesh_.to (e)); }

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
    const Rim start = sides_[0].front ();
    std::sort (sides_[1].begin (), sides_[1].end ());
    std::vector<Step> steps{{start.first, edgeOfRim (start), 0}};
    is_reached_.clear ();
    is_reached_.add (start.first);
    crossed_.clear ();
    for (std::size_t i = 0; i < steps.size () && crossed_.empty (); ++i) {
      const Index t = steps[i].triangle;
      const auto end = std::lower_bound (sides_[1].begin (), sides_[1].end (), Rim{t, 0});
      if (end != sides_[1].end () && end->first == t) {
        crossed_ = {edgeOfRim (*end), edgeOfRim (start)};
        for (std::size_t k = i; k > 0; k = steps[k].before)
          crossed_.push_back (steps[k].edge);
      }
      for (std::uint8_t side = 0; side < 3; ++side)
        if (const Index u = mesh_.neighbors[t][side]; is_taken_.has (u) && is_reached_.add (u))
          steps.push_back ({u, edgeOf ({t, side}), i});
    }
  }

  std::uint8_t crossings (Index p, Index q) const
  {
    const Edge edge = std::minmax (p, q);
    return std::find (crossed_.begin (), crossed_.end (), edge) != crossed_.end () ? 1 : 0;
  }

  const TriangleMesh& mesh_;
  const Flags& is_boundary_;
  const std::size_t longest_;
  const std::size_t largest_cap_; // triangles of a sphere that such a loop goes around
  Marks is_taken_, is_reached_;   // triangles
  Marks is_corner_, is_visited_;  // points: of triangles that were taken
  std::vector<Index> visit_of_;   // of each visited point
  std::vector<Reached> visits_;   // breadth first
  std::vector<Index> taken_;
  long euler_ = 0;                      // characteristic of the triangles that were taken
  std::vector<std::vector<Rim>> sides_; // loops at which these end, not around caps
  std::vector<Edge> crossed_;           // on a way of triangles between two sides
  std::vector<Index> cap_, fan_, ring_; // scratch
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
  NeckFinder finder (mesh, is_boundary, longest);
  Flags is_searched = is_skipped;
  is_searched.resize (positions.size (), 0);
  ProgressLoop progress (run, starts.size ());
  for (const Index p : starts) {
    progress.next ();
    if (is_searched[p] != 0)
      continue;
    std::vector<Index> loop = finder.loopNear (p);
    finder.forEachWithin (1, [&] (Index q) { is_searched[q] = 1; });
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
