// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Finds self-intersections of a mesh.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

namespace pcl::floater {
/// Two triangles that share more than their common corners: they cross, touch, or overlap in a
/// plane. Their indices, the smaller one first.
using CrossingPair = std::pair<Index, Index>;

/// Pairs of crossing triangles, sorted.
struct CrossingPairs : std::vector<CrossingPair>
{
  std::vector<Index> untested; ///< triangles that may cross others as well, ascending: the search
                               ///< ended at its limit
};

/// All pairs of triangles whose intersection is more than their common corners or edge. Exact for
/// the given positions. Degenerate triangles are ignored.
///
/// Pairs are found by a tree of boxes, and tested exactly if double precision finds no plane that
/// separates them.
///
/// O(n log n) for a mesh with few self-intersections: about a microsecond per point by one thread.
/// At most 40 microseconds per triangle, see CrossingPairs::untested.
/// \param triangles an oriented manifold, corners below the number of positions
CrossingPairs
findSelfIntersections (const std::vector<Triangle>& triangles, const Positions& positions,
                       const RunContext& run);

/// The box around a triangle.
inline Eigen::AlignedBox3d
boxOf (const Triangle& triangle, const Positions& positions)
{
  Eigen::AlignedBox3d box (positions[triangle[0]]);
  box.extend (positions[triangle[1]]);
  box.extend (positions[triangle[2]]);
  return box;
}

/// Whether two triangles share more than their common corners. Exact. False if one of them is
/// degenerate.
/// \param exact_tests counts the tests by exact predicates, which take ten times as long
bool
doCross (Triangle one, Triangle other, const Positions& positions,
         std::size_t* exact_tests = nullptr);

} // namespace pcl::floater
