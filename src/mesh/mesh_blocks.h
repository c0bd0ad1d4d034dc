// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a mesh that can be changed at the same time.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "mesh/triangle_mesh.h"

#include <algorithm>
#include <vector>

namespace pcl::floater {
/// Consecutive points, and the triangles all of whose corners are among them. Triangles beside one
/// that is not in the block are fixed. So the triangles beside one that is not fixed are all there,
/// and its cost and that of its edges are those in the whole mesh. Fewer changes are possible: none
/// across the end of the block, and no new edge between two points of which triangles are missing.
struct MeshBlock
{
  Index first = 0;   ///< the point that is point 0 here
  TriangleMesh mesh; ///< points and triangles are counted from 0
};

/// Cuts a mesh into blocks of points along the space-filling curve. The blocks do not depend on the
/// number of threads. As long as the whole mesh is changed by putBack only, blocks may be cut out
/// and put back in any order, and by several threads.
class MeshBlocks
{
public:
  /// O(n). One block for a small mesh, else up to 16 of 4,096 points or more, and beyond a million
  /// points blocks of 65,536: enough of them for as many threads, and large enough that most
  /// triangles of a surface are free. Chosen by hand.
  MeshBlocks (const TriangleMesh& mesh, const RunContext& run);

  std::size_t count () const { return triangles_.rows (); }

  /// The points of a block: from the first one to one behind the last.
  Index first (std::size_t block) const { return static_cast<Index> (block << shift_); }
  Index last (std::size_t block) const
  {
    return static_cast<Index> (std::min (is_partial_.size (), (block + 1) << shift_));
  }

  /// O(block).
  MeshBlock cutOut (const TriangleMesh& mesh, std::size_t block) const;

  /// Puts the changed triangles of a block back into the mesh. O(block).
  void putBack (const MeshBlock& part, std::size_t block, TriangleMesh& mesh) const;

  /// Whether a triangle of the mesh may be changed in its block, as long as none has been.
  bool isFree (const TriangleMesh& mesh, Index t) const;

private:
  bool areInOneBlock (const Triangle& t) const
  {
    return t[0] >> shift_ == t[1] >> shift_ && t[0] >> shift_ == t[2] >> shift_;
  }

  // The triangle as it is called in the block, NONE if it is in another one or in none.
  Index inBlock (Index t, Row block) const
  {
    return t != NONE && slot_of_[t] < block.size () && block[slot_of_[t]] == t ? slot_of_[t] : NONE;
  }

  bool hasAllNeighbors (const TriangleMesh& mesh, Index t, Row block) const;

  int shift_ = 0;              // a block has 2^shift_ points
  CsrLists triangles_;         // of each block
  std::vector<Index> slot_of_; // per triangle: its place among those of its block, or NONE
  std::vector<std::uint8_t> is_partial_; // per point: a triangle around it is in no block
};

} // namespace pcl::floater
