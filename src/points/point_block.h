// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud in blocks of bounded size, each with the points around it.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

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

/// Some points of a cloud, the block's own, and points around them, its halo.
///
/// A block owns a range of the working set: consecutive points on the space-filling curve. So the
/// order of points does not depend on how many blocks there are.
struct PointBlock
{
  std::vector<Eigen::Vector3d> positions; ///< own points and halo, in the order of the working set
  std::vector<Index> points;              ///< in the working set, ascending
  double halo = 0.0;       ///< every point is here that lies as near to an own point as that ...
  std::vector<Ball> balls; ///< ... or in one of these
};

/// Cuts a working set into blocks of nearly equal size.
class BlockCutter
{
public:
  /// O(n), 1 byte per point. \param positions of the working set; must outlive the cutter
  /// \param blocks wanted; fewer if they had less than a bucket of points each
  BlockCutter (const std::vector<Eigen::Vector3d>& positions, std::size_t blocks,
               const RunContext& run);

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

/// How many blocks a cloud is worth: one up to 262144 points, else of at most 131072 points each
/// and the same number for every thread. \param wanted 0: choose
std::size_t
chooseBlocks (std::size_t points, int wanted, const RunContext& run);

} // namespace floater
} // namespace pcl
