// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Finds self-intersections of a mesh.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

namespace pcl::floater {
/// Two triangles that share more than their common corners: they cross, touch, or overlap in a
/// plane.
struct CrossingPair
{
  Index first, second; ///< indices of the triangles, first < second

  bool operator<(const CrossingPair& other) const
  {
    return first != other.first ? first < other.first : second < other.second;
  }
  bool operator== (const CrossingPair& other) const
  {
    return first == other.first && second == other.second;
  }
};

/// Pairs of crossing triangles, sorted; see PairSearchLimits.
struct CrossingPairs : std::vector<CrossingPair>
{
  std::vector<Index> untested; ///< triangles that may cross others as well, ascending: the search
                               ///< ended at its limit
};

/// Limit of a search for pairs, against quadratic work. Where points lie along lines, each triangle
/// may overlap a large share of all others.
struct PairSearchLimits
{
  /// Work on consecutive triangles, for each of them. One unit is some 5 nanoseconds, so that a
  /// triangle may take 40 microseconds; three times as long if many tests need exact numbers.
  std::size_t work = 8000;
  std::size_t test = 30, exact_test = 500; ///< work of the tests of a pair. Measured
};

/// All pairs of triangles whose intersection is more than their common corners or edge. Exact for
/// the given positions. Degenerate triangles are ignored.
///
/// Pairs are found by a tree of boxes, and tested exactly if double precision finds no plane that
/// separates them.
///
/// O(n log n) for a mesh with few self-intersections: about a microsecond per point by one thread.
/// At most 40 microseconds per triangle, see PairSearchLimits; then there are more pairs.
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
doCross (const Triangle& one, const Triangle& other, const Positions& positions,
         std::size_t* exact_tests = nullptr);

} // namespace pcl::floater
