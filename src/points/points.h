// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The points that the stages work on.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "core/types.h"

#include <functional>
#include <vector>

namespace pcl::floater {
/// The working set: finite, distinct points in the order of a space-filling curve, so that near
/// points are near in memory. The order depends on the coordinates only, not on that of the cloud.
struct Points
{
  std::vector<Eigen::Vector3d> positions; ///< centred, scaled to a bounding box diagonal of 1
  std::vector<Eigen::Vector3d> projected; ///< on local planes where noise is strong; else empty
  std::vector<Index> cloud_index;         ///< of each point; of equal points the smallest
  std::vector<Eigen::Vector3f> normals;   ///< that are given: unit length, of arbitrary sign, zero
                                          ///< where there is none; empty if none is given
  std::vector<Eigen::Vector3f> facing_normals;       ///< the same for those that point to the front
  Eigen::Vector3d centre = Eigen::Vector3d::Zero (); ///< cloud = centre + scale * position
  double scale = 1.0;
  std::size_t lattice_width = 0; ///< of an organized cloud: points of a row; else 0
  double diagonal =
      1.0; ///< of the bounding box of the positions; 1/2 to 1 after points were removed
  std::vector<Index> non_finite;                ///< cloud indices, ascending
  std::vector<std::array<Index, 2>> duplicates; ///< cloud indices (point, the equal point that
                                                ///< stands for it), ascending

  /// The position of a point, where `positions` are not in memory but elsewhere; else empty.
  std::function<Eigen::Vector3d (Index point)> position_elsewhere = {};

  bool hasPositions () const { return !position_elsewhere; }

  std::size_t size () const { return hasPositions () ? positions.size () : cloud_index.size (); }

  /// Positions by which points are connected. The mesh is on the positions themselves.
  const std::vector<Eigen::Vector3d>& workingPositions () const
  {
    return projected.empty () ? positions : projected;
  }

  /// A position in the frame of the cloud.
  Eigen::Vector3d inCloud (Index point) const
  {
    return centre + scale * (hasPositions () ? positions[point] : position_elsewhere (point));
  }
};

/// Drops non-finite positions, centres, scales to a bounding box diagonal of 1, merges equal points
/// (the smallest cloud index stands for all), and sorts along a Hilbert curve, which is fine enough
/// for objects many orders of magnitude smaller than the box. O(n log n). Points are equal if they
/// are so after scaling. Points nearer to each other than 1e-16 of the diagonal may be, and no
/// later stage could tell them apart.
/// \param positions any
/// \param cloud_index of each position; distinct
Points
makePoints (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& cloud_index,
            const RunContext& run);

/// Normals that are given for each index of the whole cloud, or none, in the order of the points:
/// unit length, or zero where there is none. O(n).
std::vector<Eigen::Vector3f>
normalsOfPoints (const std::vector<Eigen::Vector3f>& normals, const Points& points);

/// TOO_FEW_POINTS for fewer than four points, DEGENERATE if all lie on one line. Small objects far
/// apart do not: it is enough that a quarter of the points lie beside the line as seen from one of
/// them.
Problem
checkPoints (const Points& points);

/// Takes points out; the others keep their order. Where that shrinks the bounding box, positions
/// are scaled again, by a power of two: distances compare as before, to the last bit. Duplicates of
/// a point that is taken out stay listed. For points that have not been projected. O(n).
/// \param removed points, ascending
/// \return their cloud indices, ascending
std::vector<Index>
removePoints (Points& points, const std::vector<Index>& removed);

} // namespace pcl::floater
