// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud in blocks: pieces of bounded size that can be worked on by themselves.
#pragma once

#include "common/types.h"

#include <Eigen/Geometry>

#include <vector>

namespace pcl
{
namespace floater
{
struct Ball
{
  Eigen::Vector3d centre;
  double radius;
};

/// Some points of a cloud, its own, and points around them, its halo. Nothing else is needed to
/// find the triangles that the block owns: it may be handed to another process or machine.
///
/// A block owns a range of the working set: consecutive points on the space-filling curve, so that
/// the order of points does not depend on how many blocks there are. A triangle belongs to the
/// block of its smallest point.
struct PointBlock
{
  std::vector<Eigen::Vector3d> positions; ///< own points and halo, in the order of the working set
  std::vector<Index> points;              ///< in the working set, ascending; empty: all of it
  Index first = 0, last = 0;              ///< rows of the own points: first up to before last
  bool is_all = false;                    ///< every point of the cloud is here
  double halo = 0.0;       ///< every point is here that lies as near to an own point as that ...
  std::vector<Ball> balls; ///< ... or in one of these

  Index point (Index row) const { return points.empty () ? row : points[row]; }
  std::size_t ownPoints () const { return last - first; }
};

/// Cuts a working set into blocks of nearly equal size.
class BlockCutter
{
public:
  /// O(n), 1 byte per point. \param positions of the working set; must outlive the cutter
  /// \param blocks wanted; fewer if they had less than a bucket of points each
  BlockCutter (const std::vector<Eigen::Vector3d>& positions, std::size_t blocks, int threads);

  std::size_t blocks () const { return blocks_; }

  /// Range of the working set that a block owns.
  Index first (std::size_t block) const;
  Index last (std::size_t block) const { return first (block + 1); }

  /// A block with a halo of about 12 spacings, and all points in the balls. O(points of the block).
  PointBlock cut (std::size_t block, const std::vector<Ball>& balls) const;

private:
  using Box = Eigen::AlignedBox3d;

  void appendBucket (std::size_t bucket, PointBlock& block) const;

  const std::vector<Eigen::Vector3d>& positions_;
  std::size_t blocks_;
  std::vector<Box> buckets_; // of consecutive points
  std::vector<Box> groups_;  // of consecutive buckets
};

} // namespace floater
} // namespace pcl
