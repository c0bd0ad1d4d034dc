// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles of a mesh cross which, kept up to date while the mesh changes.
#pragma once

#include "mesh/box_tree.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_mesh.h"

#include <unordered_map>
#include <vector>

namespace pcl::floater {
/// The crossing pairs of a mesh. A search changes the mesh, asks what that does to the pairs around
/// the triangles that changed, and either accepts the change or undoes it in the mesh and here. The
/// mesh must keep its number of triangles.
class CrossingTable
{
public:
  /// \param pairs all that the mesh has (see findSelfIntersections)
  CrossingTable (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<CrossingPair>& pairs, const RunContext& run);

  std::size_t pairs () const { return pairs_; }

  /// Pairs of triangles whose boxes overlap that were tested since the table was made, with weights
  /// for the time that a test takes.
  std::size_t tests () const { return tests_; }

  /// Triangles that cross others, ascending.
  std::vector<Index> crossing () const;

  bool isCrossing (Index t) const { return partners_.count (t) != 0; }

  /// Triangles that cross one; none if nullptr.
  const std::vector<Index>* partnersOf (Index t) const
  {
    const auto known = partners_.find (t);
    return known == partners_.end () ? nullptr : &known->second;
  }

  /// Pairs with one of these triangles.
  /// \param triangles ascending
  long pairsOf (const std::vector<Index>& triangles) const;

  /// Pairs that a change has added, less those that it has removed. If as many as `limit` or more,
  /// any number from `limit` on.
  /// \param changed triangles that are not as they were, ascending; followed by accept or reject
  long tryChange (const std::vector<Index>& changed, long limit);

  /// Keeps the change that was tried last.
  void accept (const std::vector<Index>& changed);

  /// After the change that was tried last has been undone in the mesh.
  void reject (const std::vector<Index>& changed) { renewBoxes (changed); }

private:
  void renewBoxes (const std::vector<Index>& changed);
  void findPartners (Index t, std::vector<Index>& partners);

  const TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  std::vector<Index> order_, place_; // triangles in the tree, and where each of them is there
  BoxTree tree_;
  std::unordered_map<Index, std::vector<Index>> partners_; // of the triangles that cross others
  std::size_t pairs_;
  std::size_t tests_ = 0;
};

} // namespace pcl::floater
