// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours from triangles.
#include "core/csr_lists.h"
#include "core/parallel.h"
#include "mesh/triangle_mesh.h"
#include "mesh/vertex_stars.h"

#include <atomic>
#include <unordered_map>

namespace pcl::floater {
namespace {
// Number of wedges up to which comparing all pairs is faster than a hash table. Measured.
constexpr std::size_t MANY_IN_STAR = 32;

// Processes points one by one. Both triangles of an edge are in the star of each of its ends, so
// the star suffices.
class StarConnector
{
public:
  StarConnector (TriangleMesh& mesh, const std::vector<std::uint8_t>* may_be_split)
      : mesh_ (mesh), may_be_split_ (may_be_split)
  {
  }

  // Sets the neighbours across the edges that leave p, and its triangle. Returns false if an edge
  // leaves it twice, or if it has several fans and may not.
  bool connect (Index p, const VertexStar& star)
  {
    mesh_.triangle_of[p] = star.size () == 0 ? NONE : star[star.size () - 1].triangle;
    if (!indexLeaving (star))
      return false;
    // A wedge is followed anti-clockwise by the one that begins at its last edge.
    after_.assign (star.size (), NONE);
    before_.assign (star.size (), NONE);
    for (Index i = 0; i < star.size (); ++i) {
      const Index j = wedgeTo (star[i].previous, star);
      after_[i] = j;
      if (j != NONE)
        before_[j] = i;
    }
    for (std::size_t i = 0; i < star.size (); ++i) {
      const Index t = star[i].triangle;
      mesh_.neighbors[t][TriangleMesh::previous (mesh_.sideOf (t, p))] =
          before_[i] == NONE ? NONE : star[before_[i]].triangle;
    }
    return (may_be_split_ != nullptr && (*may_be_split_)[p] != 0) || isOneFan ();
  }

private:
  // Returns false if two edges lead to the same point.
  bool indexLeaving (const VertexStar& star)
  {
    if (star.size () > MANY_IN_STAR) {
      leaving_ = {}; // not clear (): it visits all buckets of an earlier, larger table
      for (Index i = 0; i < star.size (); ++i)
        if (!leaving_.emplace (star[i].next, i).second)
          return false;
      return true;
    }
    for (std::size_t i = 1; i < star.size (); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (star[i].next == star[j].next)
          return false;
    return true;
  }

  // The wedge whose first edge leads to q, NONE if there is none.
  Index wedgeTo (Index q, const VertexStar& star) const
  {
    if (star.size () > MANY_IN_STAR) {
      const auto found = leaving_.find (q);
      return found == leaving_.end () ? NONE : found->second;
    }
    for (Index i = 0; i < star.size (); ++i)
      if (star[i].next == q)
        return i;
    return NONE;
  }

  bool isOneFan () const
  {
    if (after_.empty ())
      return true;
    Index start = 0;
    for (Index i = 0; i < before_.size (); ++i)
      if (before_[i] == NONE)
        start = i; // start of an open fan
    // If an edge leads to p twice, the walk may cycle without reaching its start.
    std::size_t count = 1;
    for (Index i = after_[start]; i != NONE && i != start && count <= after_.size (); i = after_[i])
      ++count;
    return count == after_.size ();
  }

  TriangleMesh& mesh_;
  const std::vector<std::uint8_t>* may_be_split_;
  std::vector<Index> after_, before_;        // of each wedge: neighbours in the fan, or NONE
  std::unordered_map<Index, Index> leaving_; // if there are many wedges: each by its first edge
};

} // namespace

bool
TriangleMesh::connect (std::size_t points, const RunContext& run,
                       const std::vector<std::uint8_t>* may_be_split)
{
  // Tables of edges have 3 entries per triangle.
  requireCountable (3 * triangles.size (), NONE - 1, "a table of edges", "use fewer points");
  run.poll ();
  triangle_of.resize (points);
  neighbors.resize (triangles.size ());
  const TriangleRanges ranges (triangles, points, run);
  std::atomic<bool> is_manifold{ranges.leftOut () == 0};
  parallelTasks (run, ranges.count (), [&] (std::size_t r) {
    if (!is_manifold)
      return;
    const VertexStars stars (triangles, ranges, r);
    StarConnector connector (*this, may_be_split);
    for (std::size_t p = ranges.firstPoint (r); p < ranges.lastPoint (r) && is_manifold; ++p)
      if (!connector.connect (static_cast<Index> (p), stars.of (p)))
        is_manifold = false;
  });
  return is_manifold;
}

} // namespace pcl::floater
