// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Crossing pairs of a mesh, updated while the mesh changes.
#pragma once

#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/box_tree.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_mesh.h"
#include "mesh/vertex_stars.h"

#include <unordered_map>

namespace pcl::floater {
/// The crossing pairs of a mesh. A search changes the mesh, asks for the effect on the pairs around
/// the changed triangles, and undoes the change in the mesh and here; or it makes a change and
/// accepts it. The number of triangles must stay.
class CrossingTable
{
public:
  /// \param pairs all pairs of the mesh (see findSelfIntersections)
  CrossingTable (const TriangleMesh& mesh, const Positions& positions,
                 const std::vector<CrossingPair>& pairs, const RunContext& run)
      : mesh_ (mesh), positions_ (positions),
        order_ (orderByPoints (mesh.triangles, positions.size ())), place_ (order_.size ()),
        tree_ (
            order_.size (),
            [this] (std::size_t i) { return boxOf (mesh_.triangles[order_[i]], positions_); }, run)
  {
    for (Index i = 0; i < order_.size (); ++i)
      place_[order_[i]] = i;
    for (const CrossingPair& pair : pairs) {
      partners_[pair.first].push_back (pair.second);
      partners_[pair.second].push_back (pair.first);
    }
  }

  /// All pairs, sorted.
  CrossingPairs pairs () const
  {
    CrossingPairs pairs;
    for (const auto& [t, partners] : partners_)
      for (const Index u : partners)
        if (t < u)
          pairs.emplace_back (t, u);
    std::sort (pairs.begin (), pairs.end ());
    return pairs;
  }

  /// Number of pairs with overlapping boxes that were tested so far, weighted by the time of a
  /// test.
  std::size_t tests () const { return tests_; }

  bool isCrossing (Index t) const { return partners_.count (t) != 0; }

  /// Triangles that cross one.
  Row partnersOf (Index t) const
  {
    const auto known = partners_.find (t);
    if (known == partners_.end ())
      return {};
    return {known->second.data (), known->second.data () + known->second.size ()};
  }

  /// Number of pairs with one of these triangles.
  /// \param triangles ascending
  long pairsOf (const std::vector<Index>& triangles) const
  {
    long pairs = 0;
    for (const Index t : triangles)
      for (const Index u : partnersOf (t))
        pairs += isCountedAt (t, u, triangles) ? 1 : 0;
    return pairs;
  }

  /// Call it after a change was undone in the mesh.
  void renewBoxes (const std::vector<Index>& changed)
  {
    for (const Index t : changed)
      tree_.set (place_[t], boxOf (mesh_.triangles[t], positions_));
  }

  /// Number of pairs added by a change, minus those removed. Exact below `limit`; otherwise any
  /// number from `limit` on.
  /// \param changed triangles, ascending; followed by renewBoxes
  long tryChange (const std::vector<Index>& changed, long limit)
  {
    renewBoxes (changed);
    long change = -pairsOf (changed);
    for (auto t = changed.begin (); t != changed.end () && change < limit; ++t)
      forPartners (*t, [&] (Index u) {
        change += isCountedAt (*t, u, changed) ? 1 : 0;
        return change >= limit;
      });
    return change;
  }

  /// Call it after a change of the mesh that is kept.
  /// \param changed triangles, ascending
  void accept (const std::vector<Index>& changed)
  {
    renewBoxes (changed);
    for (const Index t : changed) {
      const auto known = partners_.find (t);
      if (known == partners_.end ())
        continue;
      for (const Index u : known->second) {
        const auto others = partners_.find (u);
        others->second.erase (std::find (others->second.begin (), others->second.end (), t));
        if (others->second.empty ())
          partners_.erase (others);
      }
      partners_.erase (t);
    }
    for (const Index t : changed)
      forPartners (t, [&] (Index u) {
        if (isCountedAt (t, u, changed)) {
          partners_[t].push_back (u);
          partners_[u].push_back (t);
        }
        return false;
      });
  }

private:
  // A pair of two changed triangles is counted at the smaller one.
  // \param changed ascending
  static bool isCountedAt (Index t, Index u, const std::vector<Index>& changed)
  {
    return t < u || !std::binary_search (changed.begin (), changed.end (), u);
  }

  // Calls visit (u) for the triangles that cross one, until it returns true.
  template <typename Visit>
  void forPartners (Index t, Visit&& visit)
  {
    std::size_t tests = 0, exact_tests = 0;
    const Triangle& own = mesh_.triangles[t];
    tree_.forOverlaps (boxOf (own, positions_), [&] (std::size_t i) {
      const Index u = order_[i];
      ++tests;
      return u != t && doCross (own, mesh_.triangles[u], positions_, &exact_tests) && visit (u);
    });
    constexpr std::size_t PER_EXACT = 9; // simple tests in the additional time of an exact test
    tests_ += tests + PER_EXACT * exact_tests;
  }

  const TriangleMesh& mesh_;
  const Positions& positions_;
  std::vector<Index> order_, place_; // triangles in the tree, and the inverse
  BoxTree tree_;
  std::unordered_map<Index, std::vector<Index>> partners_; // of the triangles that cross others
  std::size_t tests_ = 0;
};

/// All pairs of a changed mesh. Only triangles that come are searched for pairs: a tenth of the time of
/// findSelfIntersections (), where these are few. O(n).
/// \param before other triangles of the same points; \param known all their pairs
inline CrossingPairs
pairsAfterChange (const TriangleMesh& mesh, const Positions& positions,
                  const std::vector<Triangle>& before, const CrossingPairs& known,
                  const RunContext& run)
{
  if (!known.untested.empty ())
    return findSelfIntersections (mesh.triangles, positions, run);
  std::vector<Index> now (before.size ());
  parallelPoints (run, now.size (), [&] (Index t) { now[t] = mesh.triangleWith (before[t]); });
  Flags is_new (mesh.triangles.size (), 1);
  for (const Index t : now)
    if (t != NONE)
      is_new[t] = 0;
  std::vector<CrossingPair> kept;
  for (const auto& [t, u] : known)
    if (now[t] != NONE && now[u] != NONE && now[t] != now[u])
      kept.emplace_back (std::minmax (now[t], now[u]));
  sortUnique (kept);
  CrossingTable table (mesh, positions, kept, run);
  table.accept (indicesWhere (is_new.size (), [&] (Index t) { return is_new[t] != 0; }));
  return table.pairs ();
}

} // namespace pcl::floater
