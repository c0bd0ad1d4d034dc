// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus.h"

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "mesh/vertex_stars.h"

#include <set>
#include <stdexcept>

namespace pcl::floater {
namespace {
// Removes triangles until every point has one fan.
class FanPruner
{
public:
  FanPruner (Consensus& consensus, std::size_t points)
      : triangles_ (consensus.triangles), votes_ (consensus.votes), kept_ (triangles_.size (), 1),
        around_ (makeCsrLists (points, [this] (const auto& emit) {
          for (Index t = 0; t < triangles_.size (); ++t)
            for (const Index p : triangles_[t])
              emit (p, t);
        }))
  {
  }

  void prune (const RunContext& run)
  {
    // Removing a triangle at one point may split the fan of another one, which is then tested
    // again: in the same round if it comes later.
    std::set<Index> points = pointsToPrune (run);
    if (points.empty ())
      return;
    ProgressLoop progress (run);
    while (!points.empty ()) {
      std::set<Index> later;
      for (const Index p : points) {
        progress.next ();
        dirty_.clear ();
        keepLargestFan (p);
        for (const Index q : dirty_)
          (q > p ? points : later).insert (q);
      }
      points = std::move (later);
    }
    std::size_t left = 0;
    for (Index t = 0; t < triangles_.size (); ++t) {
      progress.next ();
      if (kept_[t] != 0)
        triangles_[left++] = triangles_[t];
    }
    triangles_.resize (left);
  }

private:
  // Points whose triangles are not just one fan.
  std::set<Index> pointsToPrune (const RunContext& run) const
  {
    const TriangleRanges ranges (triangles_, around_.rows (), run);
    std::vector<std::vector<Index>> found (ranges.count ());
    parallelTasks (run, ranges.count (), [&] (std::size_t r) {
      const VertexStars stars (triangles_, ranges, r);
      StarOrder order;
      for (std::size_t p = ranges.firstPoint (r); p < ranges.lastPoint (r); ++p)
        if (!order.set (stars.of (p)) || !order.isOneFan ())
          found[r].push_back (static_cast<Index> (p));
    });
    std::set<Index> points;
    for (const std::vector<Index>& range : found)
      points.insert (range.begin (), range.end ());
    return points;
  }

  void keepLargestFan (Index p)
  {
    ring_.clear ();
    for (Index t : around_.row (p))
      if (kept_[t] != 0)
        ring_.push_back (t);
    dropDoubleEdges (p);
    if (ring_.size () < 2)
      return;
    DisjointSets fans (ring_.size ());
    for (Index a = 0; a < ring_.size (); ++a)
      for (Index b = 0; b < a; ++b)
        if (after (ring_[a], p, 1) == after (ring_[b], p, 2) ||
            after (ring_[a], p, 2) == after (ring_[b], p, 1))
          fans.join (a, b);
    std::vector<Index> weight (ring_.size (), 0);
    for (Index i = 0; i < ring_.size (); ++i)
      weight[fans.find (i)] += votes_[ring_[i]];
    const auto best = std::max_element (weight.begin (), weight.end ()) - weight.begin ();
    for (Index i = 0; i < ring_.size (); ++i)
      if (fans.find (i) != static_cast<Index> (best))
        drop (ring_[i]);
  }

  // Of triangles with the same directed edge at p, keeps the one of most votes. They occur at sharp
  // edges and between sheets: triangles may be disjoint in the tangent plane of one corner and
  // overlap in that of another.
  void dropDoubleEdges (Index p)
  {
    for (std::size_t i = 0; i < ring_.size (); ++i)
      for (std::size_t j = i + 1; j < ring_.size () && kept_[ring_[i]] != 0; ++j) {
        const Index t = ring_[i], u = ring_[j];
        if (kept_[u] != 0 &&
            (after (t, p, 1) == after (u, p, 1) || after (t, p, 2) == after (u, p, 2)))
          drop (votes_[u] > votes_[t] ? t : u);
      }
    ring_.erase (
        std::remove_if (ring_.begin (), ring_.end (), [this] (Index t) { return kept_[t] == 0; }),
        ring_.end ());
  }

  // The corner of triangle t that comes one or two steps after p.
  Index after (Index t, Index p, std::size_t steps) const
  {
    const Triangle& c = triangles_[t];
    const std::size_t at = c[0] == p ? 0 : c[1] == p ? 1 : 2;
    return c[(at + steps) % 3];
  }

  void drop (Index t)
  {
    kept_[t] = 0;
    dirty_.insert (dirty_.end (), triangles_[t].begin (), triangles_[t].end ());
  }

  std::vector<Triangle>& triangles_;
  const std::vector<std::uint8_t>& votes_;
  Flags kept_;
  const CsrLists around_;   // of each point, its triangles
  std::vector<Index> ring_; // triangles around the current point
  std::vector<Index> dirty_;
};

// Removes islands from a mesh. Returns whether there are any.
bool
removeIslands (TriangleMesh& mesh, const CsrLists& neighbors, std::size_t smallest_island,
               const RunContext& run)
{
  const MeshComponents components = findComponents (mesh, run);
  const std::vector<Index>& component = components.of_triangle;
  std::vector<std::size_t> size (components.count, 0);
  Flags is_closed (components.count, 1), is_island (components.count, 0);
  ProgressLoop progress (run);
  for (Index t = 0; t < component.size (); ++t) {
    progress.next ();
    ++size[component[t]];
    for (Index u : mesh.neighbors[t])
      if (u == NONE)
        is_closed[component[t]] = 0;
  }
  for (Index t = 0; t < component.size (); ++t) {
    progress.next ();
    const std::size_t triangles = size[component[t]];
    if (triangles >= smallest_island || is_closed[component[t]] != 0)
      continue;
    for (Index p : mesh.triangles[t])
      for (Index q : neighbors.row (p))
        if (const Index u = mesh.triangle_of[q]; u != NONE && size[component[u]] > triangles)
          is_island[component[t]] = 1;
  }
  std::size_t left = 0;
  for (Index t = 0; t < component.size (); ++t)
    if (is_island[component[t]] == 0)
      mesh.triangles[left++] = mesh.triangles[t];
  mesh.triangles.resize (left);
  return left < component.size ();
}

} // namespace

TriangleMesh
manifoldPart (Consensus consensus, const CsrLists& neighbors, std::size_t smallest_island,
              const RunContext& run)
{
  const std::size_t points = neighbors.rows ();
  FanPruner (consensus, points).prune (run);
  TriangleMesh mesh;
  mesh.triangles = std::move (consensus.triangles);
  consensus = {};
  bool is_manifold = mesh.connect (points, run);
  if (is_manifold && removeIslands (mesh, neighbors, smallest_island, run))
    is_manifold = mesh.connect (points, run);
  if (!is_manifold)
    throw std::logic_error ("the consensus is no manifold");
  return mesh;
}

} // namespace pcl::floater
