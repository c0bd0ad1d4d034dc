// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A spanning tree of the triangles, and one of the points that does not cross it, leave two edges
// for each handle (Eppstein 2003, "Dynamic generators of topologically embedded graphs"). Each of
// these edges and the tree of triangles make a ring of triangles. A loop of edges can be contracted,
// or divides the mesh, if it crosses each of these rings an even number of times.
#include "mesh/handle_loops.h"

#include "core/disjoint_sets.h"
#include "core/order_statistics.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

namespace pcl::floater {
namespace {
constexpr std::uint8_t ROOT = 3, NOT_REACHED = 4; // instead of a side

// Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators".
std::uint64_t
randomWord (std::uint64_t seed)
{
  std::uint64_t z = seed * 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

class LoopFinder
{
public:
  LoopFinder (const TriangleMesh& mesh, std::size_t longest, const RunContext& run)
      : mesh_ (mesh), longest_ (longest), run_ (run), boundary_ (boundaryLoops (mesh, run))
  {
  }

  std::vector<std::vector<Index>> find ()
  {
    if (!hasHandles ())
      return {};
    growTree ();
    markRings ();
    std::vector<Index> starts; // on each ring
    is_on_ring_.assign (mesh_.triangle_of.size (), 0);
    for (const auto& [edge, word] : words_)
      if (word != 0) {
        starts.push_back (edge.first);
        is_on_ring_[edge.first] = is_on_ring_[edge.second] = 1;
      }
    sortUnique (starts);
    visit_of_.assign (mesh_.triangle_of.size (), NONE);
    ProgressLoop progress (run_, starts.size ());
    for (const Index p : starts) {
      progress.next ();
      searchFrom (p);
    }
    std::vector<std::vector<Index>> found;
    for (auto& [word, loop] : shortest_)
      found.push_back (std::move (loop));
    std::sort (found.begin (), found.end (), [] (const auto& a, const auto& b) {
      return a.size () != b.size () ? a.size () < b.size () : a < b;
    });
    return found;
  }

private:
  using Edge = std::pair<Index, Index>; // points, the smaller first

  struct EdgeHash
  {
    std::size_t operator() (const Edge& e) const
    {
      return randomWord ((std::uint64_t{e.first} << 32U) | e.second);
    }
  };

  // A point that the search has reached: the visit before, the length of the way and the sum of the
  // words along it.
  struct Visit
  {
    Index point, before;
    std::size_t edges;
    std::uint64_t word;
  };

  Edge edgeOf (MeshEdge e) const { return std::minmax (mesh_.from (e), mesh_.to (e)); }

  // By Euler's formula.
  bool hasHandles () const
  {
    std::size_t open_edges = 0, points = 0;
    for (const std::vector<Index>& loop : boundary_)
      open_edges += loop.size ();
    for (const Index t : mesh_.triangle_of)
      points += t != NONE ? 1 : 0;
    return points + boundary_.size () != std::size_t{2} * findComponents (mesh_, run_).count +
                                             (mesh_.triangles.size () + open_edges) / 2;
  }

  // The tree of triangles, breadth first. The filling of a boundary loop is a leaf of it, beyond one
  // edge of the loop.
  void growTree ()
  {
    to_root_.assign (mesh_.triangles.size (), NOT_REACHED);
    std::vector<Index> reached;
    for (Index root = 0; root < mesh_.triangles.size (); ++root) {
      if (to_root_[root] != NOT_REACHED)
        continue;
      to_root_[root] = ROOT;
      reached.assign (1, root);
      for (std::size_t i = 0; i < reached.size (); ++i)
        for (std::uint8_t side = 0; side < 3; ++side)
          if (const MeshEdge mate = mesh_.mate ({reached[i], side});
              mate.triangle != NONE && to_root_[mate.triangle] == NOT_REACHED) {
            to_root_[mate.triangle] = mate.side;
            reached.push_back (mate.triangle);
          }
    }
  }

  void markRings ()
  {
    std::unordered_map<Index, Index> start_of; // of the loop at each point of the boundary
    for (const std::vector<Index>& loop : boundary_)
      for (const Index p : loop)
        start_of.emplace (p, loop.front ());
    std::unordered_map<Index, Index>
        leaf_of; // by the start of the loop: the triangle before the leaf
    std::vector<MeshEdge> left;
    DisjointSets joined (mesh_.triangle_of.size ());
    for (Index t = 0; t < mesh_.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const MeshEdge e{t, side}, mate = mesh_.mate (e);
        bool is_in_tree = to_root_[t] == side;
        if (mate.triangle == NONE) {
          if (start_of.at (mesh_.from (e)) == mesh_.from (e)) {
            leaf_of[mesh_.from (e)] = t;
            is_in_tree = true;
          }
        }
        else
          is_in_tree = is_in_tree || to_root_[mate.triangle] == mate.side || mate.triangle < t;
        if (!is_in_tree && !joined.join (mesh_.from (e), mesh_.to (e)))
          left.push_back (e);
      }
    for (const MeshEdge e : left) {
      const std::uint64_t word = randomWord (++rings_);
      words_[edgeOf (e)] ^= word;
      markWay (e.triangle, word);
      if (const Index other = mesh_.mate (e).triangle; other != NONE)
        markWay (other, word);
      else {
        const Index start = start_of.at (mesh_.from (e)), leaf = leaf_of.at (start);
        std::uint8_t side = 0;
        while (mesh_.neighbors[leaf][side] != NONE || mesh_.from ({leaf, side}) != start)
          ++side;
        words_[edgeOf ({leaf, side})] ^= word;
        markWay (leaf, word);
      }
    }
  }

  // From a triangle to the root. Two ways cancel each other where they are the same.
  void markWay (Index t, std::uint64_t word)
  {
    while (to_root_[t] != ROOT) {
      const MeshEdge e{t, to_root_[t]};
      words_[edgeOf (e)] ^= word;
      t = mesh_.neighbors[t][e.side];
    }
  }

  // Breadth first. Two ways to a point that cross different rings make a loop.
  void searchFrom (Index start)
  {
    visits_.assign (1, {start, NONE, 0, 0});
    visit_of_[start] = 0;
    for (Index i = 0; i < visits_.size () && 2 * visits_[i].edges < longest_; ++i) {
      mesh_.fan (visits_[i].point, fan_, ring_);
      for (const Index p : ring_)
        step (i, p);
    }
    for (const Visit& visit : visits_)
      visit_of_[visit.point] = NONE;
  }

  void step (Index i, Index p)
  {
    const Visit& visit = visits_[i];
    std::uint64_t word = visit.word;
    if (is_on_ring_[visit.point] != 0 && is_on_ring_[p] != 0)
      if (const auto at = words_.find (std::minmax (visit.point, p)); at != words_.end ())
        word ^= at->second;
    const Index j = visit_of_[p];
    if (j == NONE) {
      visit_of_[p] = static_cast<Index> (visits_.size ());
      visits_.push_back ({p, i, visit.edges + 1, word});
      return;
    }
    const std::size_t edges = visit.edges + visits_[j].edges + 1;
    if (word == visits_[j].word || edges > longest_)
      return;
    std::vector<Index>& loop = shortest_[word ^ visits_[j].word];
    if (!loop.empty () && loop.size () <= edges)
      return;
    loop.clear ();
    for (Index k = i; k != NONE; k = visits_[k].before)
      loop.push_back (visits_[k].point);
    std::reverse (loop.begin (), loop.end ());
    for (Index k = j; visits_[k].before != NONE; k = visits_[k].before)
      loop.push_back (visits_[k].point);
  }

  const TriangleMesh& mesh_;
  const std::size_t longest_;
  const RunContext& run_;
  const std::vector<std::vector<Index>> boundary_;
  std::vector<std::uint8_t> to_root_; // of each triangle: its side towards the root
  std::uint64_t rings_ = 0;
  std::unordered_map<Edge, std::uint64_t, EdgeHash> words_; // of the rings that cross an edge
  std::vector<std::uint8_t> is_on_ring_; // of each point: a ring crosses one of its edges
  std::map<std::uint64_t, std::vector<Index>> shortest_; // loops, by the rings that they cross
  std::vector<Visit> visits_;                            // scratch
  std::vector<Index> visit_of_, fan_, ring_;             // the same
};

} // namespace

std::vector<std::vector<Index>>
findHandleLoops (const TriangleMesh& mesh, std::size_t longest, const RunContext& run)
{
  return LoopFinder (mesh, longest, run).find ();
}

} // namespace pcl::floater
