// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud in blocks of bounded size, each with the points around it.
#pragma once

#include "core/run_context.h"
#include "core/types.h"
#include "points/kd_tree.h"

#include <mutex>

namespace pcl::floater {
/// Cuts a working set, which is stored elsewhere, into blocks of nearly equal size: consecutive
/// points, whose order does not depend on the number of blocks.
struct BlockCutter
{
  using Box = Eigen::AlignedBox3d;

  std::size_t points;       ///< of the working set
  std::vector<Box> buckets; ///< see makeBuckets
  std::size_t blocks;       ///< some have no points if there are more blocks than buckets

  /// Appends the positions of the points from `first` to before `last`.
  std::function<void (Index first, Index last, Positions& positions)> read;

  /// Buckets: the boxes of 64 consecutive points each. 0.75 bytes per point. O(n).
  static std::vector<Box> makeBuckets (const Positions& positions);

  /// First point of a block. For block == blocks: the number of points.
  static Index firstOf (std::size_t block, std::size_t blocks, std::size_t points);

  /// Range of the working set that is a block's own.
  Index first (std::size_t block) const { return firstOf (block, blocks, points); }
  Index last (std::size_t block) const { return first (block + 1); }
};

/// Searches among the points of a block: its own, and those around them (halo). If searches leave the
/// block, it is cut again with the balls that they covered, and they are to be repeated. So the
/// results equal those of the whole cloud.
class BlockSearch
{
public:
  /// \param cutter must outlive this
  /// \param block  not without points
  /// \param widths width of the halo, in about 12 spacings
  /// \param more   points of the working set that are to be in the block as well
  BlockSearch (const BlockCutter& cutter, std::size_t block, double widths = 1.0,
               const std::vector<Index>& more = {});

  /// Positions of the points of the block, in the order of the working set.
  const Positions& positions () const { return positions_; }

  /// Their indices in the working set, ascending.
  const std::vector<Index>& points () const { return points_; }

  /// Index in the block of a point of the working set; if it is not included, of the next one.
  Index placeOf (Index point) const;

  /// Range of the own points, as indices in the block.
  Index ownFirst () const { return placeOf (cutter_.first (index_)); }
  Index ownLast () const { return placeOf (cutter_.last (index_)); }

  /// A tree of these positions, whose searches are watched by this.
  KdTree makeTree (const RunContext& run);

  /// Cuts the block again with the balls of the searches that have left it.
  /// \return false if there are none
  bool widen ();

private:
  struct Ball
  {
    Vector3d centre;
    double radius;
  };

  void cut ();

  const BlockCutter& cutter_;
  std::size_t index_;
  std::vector<bool> is_wanted_; // of each bucket: asked for
  Positions positions_;
  std::vector<Index> points_;
  double halo_ = 0.0;       // every point within this distance of an own point is in the block
  std::vector<Ball> balls_; // every point in these is in the block
  std::mutex mutex_;        // guards the next one
  std::vector<Ball> missing_;
};

} // namespace pcl::floater
