// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The points that the stages work on.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "core/types.h"
#include "points/kd_tree.h"

namespace pcl::floater {
/// Points that lie on others, which stand for them until there is a mesh (see setAside).
struct StackedPoints
{
  Positions positions;            ///< in the order of the curve
  std::vector<Index> cloud_index; ///< of each
  std::vector<Index> of;          ///< the point of the working set that stands for it
  Positions own;                  ///< positions of the working set itself
};

/// The working set: finite, distinct points in the order of a space-filling curve, so near points
/// are near in memory. The order depends only on the coordinates.
struct Points
{
  Positions positions;                 ///< centred, scaled to a bounding box diagonal of 1
  Positions projected;                 ///< projections of noisy points on local planes; empty if
                                       ///< noise is weak
  std::vector<Index> cloud_index;      ///< of each point; the smallest of equal points
  Normals normals;                     ///< given normals: unit length, arbitrary sign, zero
                                       ///< where missing; empty if none are given
  Normals facing_normals;              ///< normals towards the front, as above
  Vector3d centre = Vector3d::Zero (); ///< cloud = centre + scale * position
  double scale = 1.0;
  StackedPoints stacked; ///< if any: each position is the mean of a point and those it stands for
  double diagonal =
      1.0; ///< of the bounding box of the positions; 1/2 to 1 after points were removed
  std::vector<Index> non_finite;                ///< cloud indices, ascending
  std::vector<std::array<Index, 2>> duplicates; ///< cloud indices (point, the equal point that
                                                ///< represents it), ascending

  std::size_t size () const { return positions.size (); }

  /// Number of points, those set aside included.
  std::size_t total () const { return size () + stacked.of.size (); }

  /// Positions by which points are connected. The mesh uses `positions`.
  const Positions& workingPositions () const { return projected.empty () ? positions : projected; }

  /// The positions of the points themselves; `positions` may be means of stacks.
  const Positions& ownPositions () const { return stacked.own.empty () ? positions : stacked.own; }

  /// A position in the frame of the cloud.
  Vector3d inCloud (Index point) const { return centre + scale * ownPositions ()[point]; }

  /// The position of a place in the frame of the cloud.
  Vector3d fromCloud (const std::array<double, 3>& place) const
  {
    return (Eigen::Map<const Vector3d> (place.data ()) - centre) / scale;
  }
};

/// Where a Hilbert curve through the box from -1/2 to 1/2 comes to the cell of a position.
std::uint64_t
hilbertCode (const Vector3d& position);

/// Drops non-finite positions, centres, scales to a bounding box diagonal of 1, merges equal points
/// (the smallest cloud index represents them), and sorts along a Hilbert curve, fine enough for
/// objects many orders of magnitude smaller than the box. O(n log n). Points are compared after
/// scaling: points nearer than 2e-16 of the diagonal may become equal, and could not be resolved
/// later.
/// \param cloud_index of each position; distinct
Points
makePoints (const Positions& positions, const std::vector<Index>& cloud_index,
            const RunContext& run);

/// Given normals of the points, from those of the whole cloud, if any: unit length, or zero where
/// missing. O(n).
Normals
normalsOfPoints (const Normals& normals, const Points& points);

/// TOO_FEW_POINTS for fewer than four points, DEGENERATE if all lie on one line. Small objects far
/// apart pass: it suffices that, seen from one of the points, a quarter of the others lie beside
/// the line.
Problem
checkPoints (const Points& points);

/// Removes points and keeps the order of the others. If the bounding box shrinks, positions are
/// scaled again, by a power of two, which keeps all comparisons of distances. Duplicates of a
/// removed point stay listed. Points on a removed one are removed with it. Not for projected points.
/// O(n).
/// \param removed points, ascending
/// \return cloud indices of all, ascending
std::vector<Index>
removePoints (Points& points, const std::vector<Index>& removed);

/// Leaves the kept points in the working set, each at the mean of itself and of the others to which
/// it is the nearest: these become Points::stacked. O(n log n).
/// \param kept ascending, not all
void
setAside (Points& points, const std::vector<Index>& kept, const RunContext& run);

/// The inverse: all points at their own positions, those set aside after the others.
Points
withStacked (const Points& points);

} // namespace pcl::floater
