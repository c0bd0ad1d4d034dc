// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Crossing pairs of a mesh, updated while the mesh changes.
#pragma once

#include "mesh/box_tree.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_mesh.h"

#include <unordered_map>
#include <vector>

namespace pcl::floater {
/// The crossing pairs of a mesh. A search changes the mesh, asks for the effect on the pairs around
/// the changed triangles, and then accepts the change, or undoes it in the mesh and here. The
/// number of triangles must stay.
class CrossingTable
{
public:
  /// \param pairs all pairs of the mesh (see findSelfIntersections)
  CrossingTable (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<CrossingPair>& pairs, const RunContext& run);

  std::size_t pairs () const { return pairs_; }

  /// Number of pairs with overlapping boxes that were tested so far, weighted by the time of a
  /// test.
  std::size_t tests () const { return tests_; }

  /// Triangles that cross others, ascending.
  std::vector<Index> crossing () const;

  bool isCrossing (Index t) const { return partners_.count (t) != 0; }

  /// Triangles that cross one; nullptr: none.
  const std::vector<Index>* partnersOf (Index t) const
  {
    const auto known = partners_.find (t);
    return known == partners_.end () ? nullptr : &known->second;
  }

  /// Number of pairs with one of these triangles.
  /// \param triangles ascending
  long pairsOf (const std::vector<Index>& triangles) const;

  /// Number of pairs added by a change, minus those removed. Exact below `limit`; otherwise any
  /// number from `limit` on.
  /// \param changed triangles, ascending; followed by accept or reject
  long tryChange (const std::vector<Index>& changed, long limit);

  /// Keeps the last change.
  void accept (const std::vector<Index>& changed);

  /// Call it after the last change was undone in the mesh.
  void reject (const std::vector<Index>& changed) { renewBoxes (changed); }

private:
  void renewBoxes (const std::vector<Index>& changed);
  void findPartners (Index t, std::vector<Index>& partners);

  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  std::vector<Index> order_, place_; // triangles in the tree, and the inverse
  BoxTree tree_;
  std::unordered_map<Index, std::vector<Index>> partners_; // of the triangles that cross others
  std::size_t pairs_;
  std::size_t tests_ = 0;
};

} // namespace pcl::floater
