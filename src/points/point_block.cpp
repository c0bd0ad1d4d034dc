// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/point_block.h"

#include "core/order_statistics.h"
#include "core/parallel.h"

#include <algorithm>
#include <utility>

namespace pcl::floater {
namespace {
constexpr std::size_t BUCKET = 64; // points; a bucket is about 8 spacings wide, its diagonal 12

std::size_t
bucketsOf (std::size_t points)
{
  return (points + BUCKET - 1) / BUCKET;
}

// Exceeds one by more than the rounding of a sum of distances.
constexpr double ENLARGED = 1.0 + 1e-9;

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

Index
PointBlock::placeOf (Index point) const
{
  return static_cast<Index> (std::lower_bound (points.begin (), points.end (), point) -
                             points.begin ());
}

BlockCutter::BlockCutter (std::size_t points, std::vector<Box> groups, std::size_t blocks,
                          ReadBuckets read_buckets, Read read)
    : points_ (points), groups_ (std::move (groups)), blocks_ (blocks),
      read_buckets_ (std::move (read_buckets)), read_ (std::move (read))
{
}

std::vector<BlockCutter::Box>
BlockCutter::makeBuckets (const std::vector<Eigen::Vector3d>& positions, const RunContext& run)
{
  std::vector<Box> buckets (bucketsOf (positions.size ()));
  parallelRanges (run, buckets.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t bucket = first; bucket < last; ++bucket)
      for (std::size_t p = bucket * BUCKET; p < std::min ((bucket + 1) * BUCKET, positions.size ());
           ++p)
        buckets[bucket].extend (positions[p]);
  });
  return buckets;
}

std::vector<BlockCutter::Box>
BlockCutter::makeGroups (const std::vector<Box>& buckets)
{
  std::vector<Box> groups;
  for (std::size_t bucket = 0; bucket < buckets.size (); bucket += GROUP)
    groups.push_back (unite (buckets, bucket, std::min (bucket + GROUP, buckets.size ())));
  return groups;
}

Index
BlockCutter::firstOf (std::size_t block, std::size_t blocks, std::size_t points)
{
  return static_cast<Index> (std::min (points, block * bucketsOf (points) / blocks * BUCKET));
}

BlockCutter::Buckets
BlockCutter::readBuckets (std::size_t first, std::size_t last) const
{
  Buckets buckets{first, last, {}};
  read_buckets_ (first, last, buckets.boxes);
  return buckets;
}

void
BlockCutter::append (std::size_t first_bucket, std::size_t last_bucket, PointBlock& block) const
{
  const auto first = static_cast<Index> (first_bucket * BUCKET);
  const auto last = static_cast<Index> (std::min (last_bucket * BUCKET, points_));
  read_ (first, last, block.positions);
  for (Index p = first; p < last; ++p)
    block.points.push_back (p);
}

// Whether a box is near a bucket of the block.
bool
BlockCutter::isNear (const Box& box, const Buckets& own, double halo) const
{
  for (std::size_t first = own.first, last = 0; first < own.last; first = last) {
    const std::size_t group = first / GROUP;
    last = std::min ((group + 1) * GROUP, own.last);
    if (!isWithin (box, groups_[group], halo))
      continue;
    for (std::size_t bucket = first; bucket < last; ++bucket)
      if (isWithin (box, own[bucket], halo))
        return true;
  }
  return false;
}

PointBlock
BlockCutter::cut (std::size_t block, const std::vector<Ball>& balls, double widths) const
{
  PointBlock cut;
  const std::size_t count = bucketsOf (points_);
  const Buckets own = readBuckets (block * count / blocks_, (block + 1) * count / blocks_);
  const Box own_box = unite (own.boxes, 0, own.boxes.size ());
  std::vector<double> diagonals;
  for (const Box& box : own.boxes)
    diagonals.push_back (box.diagonal ().norm ());
  cut.halo = diagonals.empty () ? 0.0 : widths * median (diagonals);
  cut.balls = balls;

  const auto isWanted = [&] (const Box& box, bool closely) {
    for (const Ball& ball : balls)
      if (box.squaredExteriorDistance (ball.centre) <= ball.radius * ball.radius)
        return true;
    return isWithin (box, own_box, cut.halo) && (!closely || isNear (box, own, cut.halo));
  };
  const auto isWantedGroup = [&] (std::size_t group) {
    return (group * GROUP < own.last && own.first < (group + 1) * GROUP) ||
           isWanted (groups_[group], false);
  };
  std::size_t run_first = 0, run_last = 0; // range of requested buckets
  const auto appendBucket = [&] (std::size_t bucket) {
    if (bucket != run_last) {
      append (run_first, run_last, cut);
      run_first = bucket;
    }
    run_last = bucket + 1;
  };
  for (std::size_t group = 0, end = 0; group < groups_.size (); group = end) {
    for (end = group; end < groups_.size () && isWantedGroup (end);)
      ++end;
    if (end == group) {
      ++end;
      continue;
    }
    const Buckets found = readBuckets (group * GROUP, std::min (end * GROUP, count));
    for (std::size_t bucket = found.first; bucket < found.last; ++bucket)
      if (own.has (bucket) || isWanted (found[bucket], true))
        appendBucket (bucket);
  }
  append (run_first, run_last, cut);
  return cut;
}

BlockSearch::BlockSearch (const BlockCutter& cutter, std::size_t block, const RunContext& run,
                          double widths)
    : cutter_ (cutter), index_ (block), run_ (run), widths_ (widths)
{
  cut ();
}

void
BlockSearch::cut ()
{
  tree_.reset ();
  block_ = cutter_.cut (index_, block_.balls, widths_);
}

const KdTree&
BlockSearch::tree ()
{
  if (!tree_) {
    tree_.emplace (block_.positions, run_, PointOrder::ALONG_CURVE);
    tree_->setWatch (this);
  }
  return *tree_;
}

bool
BlockSearch::hasLeft ()
{
  const std::lock_guard<std::mutex> lock (mutex_);
  const bool has_left = missing_.size () > asked_;
  asked_ = missing_.size ();
  return has_left;
}

std::vector<Index>
BlockSearch::left ()
{
  std::vector<Index> points;
  std::vector<Neighbor> found;
  for (const Ball& ball : missing_) {
    tree ().nearest (ball.centre, 1, found); // the point itself: positions are distinct
    points.push_back (block_.points[found.front ().point]);
  }
  sortUnique (points);
  return points;
}

bool
BlockSearch::widen ()
{
  if (missing_.empty ())
    return false;
  block_.balls.insert (block_.balls.end (), missing_.begin (), missing_.end ());
  missing_.clear ();
  asked_ = 0;
  cut ();
  return true;
}

void
BlockSearch::looked (const Eigen::Vector3d& centre, double radius)
{
  if (radius * ENLARGED <= block_.halo)
    return;
  const auto isHere = [&] (const Ball& ball) {
    return ((ball.centre - centre).norm () + radius) * ENLARGED <= ball.radius;
  };
  if (std::any_of (block_.balls.begin (), block_.balls.end (), isHere))
    return;
  const std::lock_guard<std::mutex> lock (mutex_);
  missing_.push_back ({centre, radius * ENLARGED * ENLARGED});
}

} // namespace pcl::floater
