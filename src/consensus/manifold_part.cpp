// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus.h"

#include "core/disjoint_sets.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/vertex_stars.h"

#include <set>
#include <stdexcept>

namespace pcl::floater {
namespace {
// The triangles around a point but for the fan of most votes. Of triangles with the same directed edge,
// that of fewer votes is in no fan: at sharp edges and between sheets, triangles may be disjoint in
// the tangent plane of one corner and overlap in that of another.
std::vector<Index>
besideBestFan (const VertexStar& star, const std::vector<std::uint8_t>& votes)
{
  const auto size = static_cast<Index> (star.size ());
  const auto isWorse = [&] (Index i, Index j) {
    const std::uint8_t own = votes[star[i].triangle], other = votes[star[j].triangle];
    return own != other ? own < other : i > j;
  };
  Flags is_in (size, 1);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j)
      if (j != i && is_in[j] != 0 && isWorse (i, j) &&
          (star[i].next == star[j].next || star[i].previous == star[j].previous))
        is_in[i] = 0;
  DisjointSets fans (size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j)
      if (is_in[i] != 0 && is_in[j] != 0 && star[i].previous == star[j].next)
        fans.join (i, j);
  std::vector<std::size_t> weight (size, 0);
  for (Index i = 0; i < size; ++i)
    weight[fans.find (i)] += is_in[i] != 0 ? votes[star[i].triangle] : 0;
  const auto best =
      static_cast<Index> (std::max_element (weight.begin (), weight.end ()) - weight.begin ());
  std::vector<Index> beside;
  for (Index i = 0; i < size; ++i)
    if (is_in[i] == 0 || fans.find (i) != best)
      beside.push_back (star[i].triangle);
  return beside;
}

// Removes triangles until every point has one fan. Where one is removed, the fan of another point may
// be split: what is to go there is decided in the next round.
void
pruneFans (Consensus& consensus, std::size_t points, const RunContext& run)
{
  struct Pruned
  {
    Index point;
    std::vector<Index> beside;
  };
  for (bool has_changed = true; has_changed;) {
    const TriangleRanges ranges (consensus.triangles, points, run);
    std::vector<std::vector<Pruned>> found (ranges.count ());
    parallelTasks (run, ranges.count (), [&] (std::size_t r) {
      const VertexStars stars (consensus.triangles, ranges, r);
      StarOrder order;
      for (auto p = static_cast<Index> (ranges.firstPoint (r)); p < ranges.lastPoint (r); ++p)
        if (const VertexStar star = stars.of (p); !order.set (star) || !order.isOneFan ())
          found[r].push_back ({p, besideBestFan (star, consensus.votes)});
    });
    std::vector<Index> removed;
    std::set<Index> changed;
    for (const std::vector<Pruned>& range : found)
      for (const auto& [p, beside] : range)
        if (changed.count (p) == 0)
          for (const Index t : beside) {
            removed.push_back (t);
            changed.insert (consensus.triangles[t].begin (), consensus.triangles[t].end ());
          }
    sortUnique (removed);
    eraseRows (consensus.triangles, removed);
    eraseRows (consensus.votes, removed);
    has_changed = !removed.empty ();
  }
}

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
  pruneFans (consensus, points, run);
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
