// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud in blocks of bounded size, each with the points around it.
#pragma once

#include "core/run_context.h"
#include "core/types.h"
#include "points/kd_tree.h"

#include <Eigen/Geometry>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace pcl::floater {
struct Ball
{
  Eigen::Vector3d centre;
  double radius;
};

/// Consecutive points of a cloud (own points), and points around them (halo). The order of the
/// points does not depend on the number of blocks.
struct PointBlock
{
  std::vector<Eigen::Vector3d> positions; ///< own points and halo, in the order of the working set
  std::vector<Index> points;              ///< their indices in the working set, ascending
  double halo = 0.0;       ///< every point within this distance of an own point is included
  std::vector<Ball> balls; ///< so is every point in these balls

  /// Index in the block of a point of the working set; if it is not included, of the next one.
  Index placeOf (Index point) const;
};

/// Cuts a working set into blocks of nearly equal size.
class BlockCutter
{
public:
  using Box = Eigen::AlignedBox3d;

  /// Appends the positions of the points from `first` to before `last`.
  using Read =
      std::function<void (Index first, Index last, std::vector<Eigen::Vector3d>& positions)>;

  /// Appends the buckets from `first` to before `last`.
  using ReadBuckets =
      std::function<void (std::size_t first, std::size_t last, std::vector<Box>& buckets)>;

  /// For positions and buckets that are stored elsewhere: 0.012 bytes per point. If there are more
  /// blocks than buckets, some blocks have no points; these cannot be cut.
  /// \param groups see makeGroups
  /// \param read_buckets reads results of makeBuckets
  BlockCutter (std::size_t points, std::vector<Box> groups, std::size_t blocks,
               ReadBuckets read_buckets, Read read);

  /// Buckets: the boxes of 64 consecutive points each. O(n).
  static std::vector<Box> makeBuckets (const std::vector<Eigen::Vector3d>& positions,
                                       const RunContext& run);

  static constexpr std::size_t GROUP = 64; ///< buckets in a group

  /// Groups: the boxes of GROUP consecutive buckets or other boxes. O(n).
  static std::vector<Box> makeGroups (const std::vector<Box>& buckets);

  std::size_t blocks () const { return blocks_; }

  /// First point of a block. For block == blocks: the number of points.
  static Index firstOf (std::size_t block, std::size_t blocks, std::size_t points);

  /// Range of the working set that is a block's own.
  Index first (std::size_t block) const { return firstOf (block, blocks_, points_); }
  Index last (std::size_t block) const { return first (block + 1); }

  /// A block with a halo of about 12 spacings, and all points in the balls. O(points of the block).
  /// \param widths factor for a wider halo
  PointBlock cut (std::size_t block, const std::vector<Ball>& balls, double widths = 1.0) const;

private:
  // Consecutive buckets.
  struct Buckets
  {
    std::size_t first = 0, last = 0;
    std::vector<Box> boxes;

    const Box& operator[] (std::size_t bucket) const { return boxes[bucket - first]; }
    bool has (std::size_t bucket) const { return bucket >= first && bucket < last; }
  };

  Buckets readBuckets (std::size_t first, std::size_t last) const;
  bool isNear (const Box& box, const Buckets& own, double halo) const;
  void append (std::size_t first_bucket, std::size_t last_bucket, PointBlock& block) const;

  std::size_t points_;
  std::vector<Box> groups_;
  std::size_t blocks_;
  ReadBuckets read_buckets_;
  Read read_;
};

/// Searches among the points of a block. If searches leave the block, it is cut again with the
/// balls that they covered, and they are repeated. The results equal those of the whole cloud.
class BlockSearch : private SearchWatch
{
public:
  /// \param cutter must outlive this
  /// \param widths see BlockCutter::cut
  BlockSearch (const BlockCutter& cutter, std::size_t block, const RunContext& run,
               double widths = 1.0);
  ~BlockSearch () override = default;

  /// Block and tree change when the block is widened. The first call of tree () makes it and is for
  /// one thread; then any number of threads may use it.
  const PointBlock& block () const { return block_; }
  const KdTree& tree ();

  /// Range of the own points, as indices in the block.
  Index ownFirst () const { return block_.placeOf (cutter_.first (index_)); }
  Index ownLast () const { return ownFirst () + (cutter_.last (index_) - cutter_.first (index_)); }

  /// Receives searches other than those of tree ().
  SearchWatch& watch () { return *this; }

  /// Whether searches since the last call covered balls that leave the block. They are stored for
  /// widen ().
  bool hasLeft ();

  /// The own points around which searches have left the block since it was cut, ascending.
  std::vector<Index> left ();

  /// Cuts the block again with these balls, and makes its tree.
  /// \return false if there are none
  bool widen ();

private:
  void looked (const Eigen::Vector3d& centre, double radius) override;
  void cut ();

  const BlockCutter& cutter_;
  std::size_t index_;
  const RunContext run_;
  double widths_;
  PointBlock block_;
  std::optional<KdTree> tree_;
  std::mutex mutex_; // guards the next one
  std::vector<Ball> missing_;
  std::size_t asked_ = 0; // of them when hasLeft () was last asked
};

} // namespace pcl::floater
