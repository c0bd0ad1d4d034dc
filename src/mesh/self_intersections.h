// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of a mesh that cross each other.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <Eigen/Geometry>

#include <vector>

namespace pcl::floater {
/// Two triangles that have more in common than their common corners: they cross, touch, or overlap
/// in a plane.
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

/// All pairs of triangles whose intersection is more than the corners or the edge that both name.
/// The decisions are exact for the positions as they are given, as by exact arithmetic. A triangle
/// whose corners lie on one line is left out.
///
/// Most pairs share a corner. They are settled all at once where the fan around that corner is seen
/// without overlaps from some direction; only pairs at other corners are tested one by one. Other
/// pairs are found by a tree of boxes, and tested if no separating plane is seen in double
/// precision.
///
/// O(n log n) for a mesh that crosses itself in few places: about a microsecond per point by one
/// thread. In the worst case all pairs of triangles.
/// \param triangles an oriented manifold, corners below the number of positions
/// \return sorted
std::vector<CrossingPair>
findSelfIntersections (const std::vector<Triangle>& triangles,
                       const std::vector<Eigen::Vector3d>& positions, const RunContext& run);

/// The pairs of findSelfIntersections of which the first is among some triangles, which may be
/// found apart from the others: all parts of a mesh together have all pairs once.
///
/// \param triangles  in the order of their smallest points (see orderByPoints): those of the part,
///                   and at least all others whose boxes overlap or touch one of them
/// \param first,last the part: from `first` to before `last`
/// \return places in `triangles`, the smaller one first; sorted
std::vector<CrossingPair>
findSelfIntersectionsOf (const std::vector<Triangle>& triangles, std::size_t first,
                         std::size_t last, const std::vector<Eigen::Vector3d>& positions,
                         const RunContext& run);

/// Pairs of places in an order become pairs of triangles.
/// \return sorted
/// \param order triangle of each place
std::vector<CrossingPair>
pairsInOrder (const std::vector<CrossingPair>& places, const std::vector<Index>& order);

/// The box around a triangle.
inline Eigen::AlignedBox3d
boxOf (const Triangle& triangle, const std::vector<Eigen::Vector3d>& positions)
{
  Eigen::AlignedBox3d box (positions[triangle[0]]);
  box.extend (positions[triangle[1]]);
  box.extend (positions[triangle[2]]);
  return box;
}

/// Whether two triangles have more in common than the corners that both name. Exact. False if the
/// corners of one of them lie on one line.
/// \param exact_tests counts the tests by exact predicates: they take ten times as long, and count
/// three times where exact numbers are needed for them
bool
doCross (const Triangle& one, const Triangle& other, const std::vector<Eigen::Vector3d>& positions,
         std::size_t* exact_tests = nullptr);

} // namespace pcl::floater
