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

  /// Place of a point of the working set that is here; else of the next one.
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

  /// O(n), 1 byte per point.
  /// \param positions of the working set; must outlive the cutter
  /// \param blocks wanted; fewer if they had less than a bucket of points each
  BlockCutter (const std::vector<Eigen::Vector3d>& positions, std::size_t blocks,
               const RunContext& run);

  /// The same for positions and buckets that lie elsewhere: 0.012 bytes per point. If there are
  /// more blocks than buckets, some blocks have no points; these cannot be cut.
  /// \param groups see makeGroups
  /// \param read_buckets those of makeBuckets
  BlockCutter (std::size_t points, std::vector<Box> groups, std::size_t blocks,
               ReadBuckets read_buckets, Read read);

  /// Buckets: the boxes of 64 consecutive points each. O(n).
  static std::vector<Box> makeBuckets (const std::vector<Eigen::Vector3d>& positions,
                                       const RunContext& run);

  static constexpr std::size_t GROUP = 64; ///< buckets in a group

  /// Groups: the boxes of GROUP consecutive buckets each, or of other boxes in a row. O(n).
  static std::vector<Box> makeGroups (const std::vector<Box>& buckets);

  std::size_t blocks () const { return blocks_; }

  /// First point of a block, or the number of points for the one behind the last.
  static Index firstOf (std::size_t block, std::size_t blocks, std::size_t points);

  /// Range of the working set that a block owns.
  Index first (std::size_t block) const { return firstOf (block, blocks_, points_); }
  Index last (std::size_t block) const { return first (block + 1); }

  /// A block with a halo of about 12 spacings, and all points in the balls. O(points of the block).
  /// \param widths of such halos, for a wider one
  PointBlock cut (std::size_t block, const std::vector<Ball>& balls, double widths = 1.0) const;

private:
  BlockCutter (const std::vector<Eigen::Vector3d>& positions,
               const std::shared_ptr<const std::vector<Box>>& buckets, std::size_t blocks);

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

/// Searches among the points of a block that may leave it: then the block is cut anew, with the
/// balls in which they looked, and the search goes on. So the results are those of the whole cloud.
class BlockSearch : private SearchWatch
{
public:
  /// \param cutter must outlive this
  /// \param widths see BlockCutter::cut
  BlockSearch (const BlockCutter& cutter, std::size_t block, const RunContext& run,
               double widths = 1.0);
  ~BlockSearch () override = default;
  BlockSearch (const BlockSearch&) = delete;
  BlockSearch& operator= (const BlockSearch&) = delete;
  BlockSearch (BlockSearch&&) = delete;
  BlockSearch& operator= (BlockSearch&&) = delete;

  /// Both change where a search leaves the block. The tree is made when it is first asked for, by
  /// one thread; until the block changes, any number of them may use it then.
  const PointBlock& block () const { return block_; }
  const KdTree& tree ();

  /// The own points, as places in the block: from the first one to one behind the last.
  Index ownFirst () const { return block_.placeOf (cutter_.first (index_)); }
  Index ownLast () const { return ownFirst () + (cutter_.last (index_) - cutter_.first (index_)); }

  /// Is told of searches that are not among those of tree ().
  SearchWatch& watch () { return *this; }

  /// Whether searches, since this was last asked, looked into balls that the block does not have.
  /// They are noted for widen ().
  bool hasLeft ();

  /// The own points around which searches have left the block since it was cut, ascending.
  std::vector<Index> left ();

  /// Cuts the block anew with these balls, and makes its tree.
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

/// How many blocks a cloud is worth: one up to 262144 points, else of at most 131072 points each
/// and the same number for every thread.
/// \param wanted 0: choose
std::size_t
chooseBlocks (std::size_t points, int wanted, const RunContext& run);

} // namespace pcl::floater
