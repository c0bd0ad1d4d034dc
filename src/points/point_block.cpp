// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/point_block.h"

#include "core/order_statistics.h"
#include "core/parallel.h"

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t BLOCK = 131072; // points: the halo then adds a tenth to the work
constexpr std::size_t BUCKET = 64;    // points; a bucket is about 8 spacings wide, its diagonal 12
constexpr std::size_t GROUP = 64;     // buckets

Eigen::AlignedBox3d
unite (const std::vector<Eigen::AlignedBox3d>& boxes, std::size_t first, std::size_t last)
{
  Eigen::AlignedBox3d box;
  for (std::size_t i = first; i < last; ++i)
    box.extend (boxes[i]);
  return box;
}

bool
isWithin (const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double distance)
{
  return a.squaredExteriorDistance (b) <= distance * distance;
}
} // namespace

BlockCutter::BlockCutter (const std::vector<Eigen::Vector3d>& positions, std::size_t blocks,
                          const RunContext& run)
    : positions_ (positions), buckets_ ((positions.size () + BUCKET - 1) / BUCKET)
{
  parallelRanges (run, buckets_.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t bucket = first; bucket < last; ++bucket)
      for (std::size_t p = bucket * BUCKET; p < std::min ((bucket + 1) * BUCKET, positions.size ());
           ++p)
        buckets_[bucket].extend (positions[p]);
  });
  for (std::size_t bucket = 0; bucket < buckets_.size (); bucket += GROUP)
    groups_.push_back (unite (buckets_, bucket, std::min (bucket + GROUP, buckets_.size ())));
  blocks_ = std::clamp<std::size_t> (blocks, 1, std::max<std::size_t> (1, buckets_.size ()));
}

Index
BlockCutter::first (std::size_t block) const
{
  return static_cast<Index> (
      std::min (positions_.size (), block * buckets_.size () / blocks_ * BUCKET));
}

void
BlockCutter::appendBucket (std::size_t bucket, PointBlock& block) const
{
  const std::size_t last = std::min ((bucket + 1) * BUCKET, positions_.size ());
  for (std::size_t p = bucket * BUCKET; p < last; ++p) {
    block.positions.push_back (positions_[p]);
    block.points.push_back (static_cast<Index> (p));
  }
}

PointBlock
BlockCutter::cut (std::size_t block, const std::vector<Ball>& balls) const
{
  PointBlock cut;
  const std::size_t own_first = block * buckets_.size () / blocks_;
  const std::size_t own_last = (block + 1) * buckets_.size () / blocks_;
  const Box own = unite (buckets_, own_first, own_last);
  std::vector<double> diagonals;
  for (std::size_t bucket = own_first; bucket < own_last; ++bucket)
    diagonals.push_back (buckets_[bucket].diagonal ().norm ());
  cut.halo = median (diagonals);
  cut.balls = balls;

  const auto isWanted = [&] (const Box& box, bool closely) {
    for (const Ball& ball : balls)
      if (box.squaredExteriorDistance (ball.centre) <= ball.radius * ball.radius)
        return true;
    if (!isWithin (box, own, cut.halo))
      return false;
    return !closely ||
           std::any_of (buckets_.begin () + static_cast<std::ptrdiff_t> (own_first),
                        buckets_.begin () + static_cast<std::ptrdiff_t> (own_last),
                        [&] (const Box& other) { return isWithin (box, other, cut.halo); });
  };
  for (std::size_t group = 0; group < groups_.size (); ++group) {
    const std::size_t first = group * GROUP, last = std::min (first + GROUP, buckets_.size ());
    const bool has_own = first < own_last && own_first < last;
    if (!has_own && !isWanted (groups_[group], false))
      continue;
    for (std::size_t bucket = first; bucket < last; ++bucket) {
      const bool is_own = bucket >= own_first && bucket < own_last;
      if (is_own || isWanted (buckets_[bucket], true))
        appendBucket (bucket, cut);
    }
  }
  return cut;
}

std::size_t
chooseBlocks (std::size_t points, int wanted, const RunContext& run)
{
  if (wanted > 0)
    return static_cast<std::size_t> (wanted);
  if (points <= 2 * BLOCK)
    return 1;
  const auto at_once = static_cast<std::size_t> (run.threads ());
  return (points / BLOCK + at_once) / at_once * at_once;
}

} // namespace floater
} // namespace pcl
