// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks of a mesh that can be changed concurrently.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "mesh/triangle_mesh.h"

#include <algorithm>
#include <vector>

namespace pcl::floater {
/// Consecutive points, and the triangles whose corners are all among them. Triangles beside one
/// outside of the block are fixed. So a free triangle has all its neighbours here, and its cost and
/// that of its edges are as in the whole mesh. Not possible are changes across the end of the
/// block, and new edges between two partial points.
struct MeshBlock
{
  Index first = 0;   ///< point of the mesh that is point 0 here
  TriangleMesh mesh; ///< points and triangles are numbered from 0
};

/// Cuts a mesh into blocks of points along the space-filling curve. The blocks do not depend on the
/// number of threads. While the mesh is changed by putBack only, blocks may be cut out and put back
/// in any order, by several threads.
class MeshBlocks
{
public:
  /// O(n). One block for a small mesh, otherwise up to 16 of 4,096 points or more; beyond a million
  /// points blocks of 65,536: enough for as many threads, and large enough that most triangles are
  /// free. Chosen by hand.
  MeshBlocks (const TriangleMesh& mesh, const RunContext& run);

  std::size_t count () const { return triangles_.rows (); }

  /// First point of a block, and one past its last.
  Index first (std::size_t block) const { return static_cast<Index> (block << shift_); }
  Index last (std::size_t block) const
  {
    return static_cast<Index> (std::min (is_partial_.size (), (block + 1) << shift_));
  }

  /// O(block).
  MeshBlock cutOut (const TriangleMesh& mesh, std::size_t block) const;

  /// Copies the triangles of a changed block back into the mesh. O(block).
  void putBack (const MeshBlock& part, std::size_t block, TriangleMesh& mesh) const;

  /// Whether a triangle of the unchanged mesh is free in its block.
  bool isFree (const TriangleMesh& mesh, Index t) const;

private:
  bool areInOneBlock (const Triangle& t) const
  {
    return t[0] >> shift_ == t[1] >> shift_ && t[0] >> shift_ == t[2] >> shift_;
  }

  // Index of the triangle in the block, NONE if it is not in this one.
  Index inBlock (Index t, Row block) const
  {
    return t != NONE && slot_of_[t] < block.size () && block[slot_of_[t]] == t ? slot_of_[t] : NONE;
  }

  bool hasAllNeighbors (const TriangleMesh& mesh, Index t, Row block) const;

  int shift_ = 0;                        // a block has 2^shift_ points
  CsrLists triangles_;                   // of each block
  std::vector<Index> slot_of_;           // per triangle: index among those of its block, or NONE
  std::vector<std::uint8_t> is_partial_; // per point: a triangle around it is in no block
};

} // namespace pcl::floater
