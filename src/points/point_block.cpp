// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/point_block.h"

#include "core/order_statistics.h"

namespace pcl::floater {
namespace {
constexpr std::size_t BUCKET = 64;  // points; a bucket is about 8 spacings wide, its diagonal 12
constexpr std::size_t GROUPED = 64; // buckets of a common box

// Exceeds one by more than the rounding of a sum of distances.
constexpr double ENLARGED = 1.0 + 1e-9;

using Box = BlockCutter::Box;

std::size_t
bucketsOf (std::size_t points)
{
  return (points + BUCKET - 1) / BUCKET;
}

Box
unite (const std::vector<Box>& boxes, std::size_t first, std::size_t last)
{
  Box box;
  for (std::size_t i = first; i < last; ++i)
    box.extend (boxes[i]);
  return box;
}
} // namespace

std::vector<Box>
BlockCutter::makeBuckets (const Positions& positions)
{
  std::vector<Box> buckets (bucketsOf (positions.size ()));
  for (std::size_t p = 0; p < positions.size (); ++p)
    buckets[p / BUCKET].extend (positions[p]);
  return buckets;
}

Index
BlockCutter::firstOf (std::size_t block, std::size_t blocks, std::size_t points)
{
  return static_cast<Index> (std::min (points, block * bucketsOf (points) / blocks * BUCKET));
}

BlockSearch::BlockSearch (const BlockCutter& cutter, std::size_t block, double widths,
                          const std::vector<Index>& more)
    : cutter_ (cutter), index_ (block), is_wanted_ (cutter.buckets.size ())
{
  for (const Index p : more)
    is_wanted_[p / BUCKET] = true;
  std::vector<double> diagonals;
  for (std::size_t p = cutter.first (block); p < cutter.last (block); p += BUCKET) {
    is_wanted_[p / BUCKET] = true;
    diagonals.push_back (cutter.buckets[p / BUCKET].diagonal ().norm ());
  }
  halo_ = widths * median (diagonals);
  cut ();
}

void
BlockSearch::cut ()
{
  const std::vector<Box>& buckets = cutter_.buckets;
  const std::size_t own_first = cutter_.first (index_) / BUCKET,
                    own_last = bucketsOf (cutter_.last (index_));
  const Box own_box = unite (buckets, own_first, own_last);
  std::vector<Box> own_groups;
  for (std::size_t bucket = own_first; bucket < own_last; bucket += GROUPED)
    own_groups.push_back (unite (buckets, bucket, std::min (bucket + GROUPED, own_last)));
  const auto isNear = [this] (const Box& one, const Box& other) {
    return one.squaredExteriorDistance (other) <= halo_ * halo_;
  };
  const auto isAround = [&] (const Box& box) {
    return (isNear (box, own_box) &&
            std::any_of (own_groups.begin (), own_groups.end (),
                         [&] (const Box& group) { return isNear (box, group); })) ||
           std::any_of (balls_.begin (), balls_.end (), [&box] (const Ball& ball) {
             return box.squaredExteriorDistance (ball.centre) <= ball.radius * ball.radius;
           });
  };
  points_.clear ();
  positions_.clear ();
  for (std::size_t first = 0, last = 0; first < buckets.size (); first = last) {
    last = std::min (first + GROUPED, buckets.size ());
    const bool may_be_around = isAround (unite (buckets, first, last));
    for (std::size_t bucket = first; bucket < last; ++bucket)
      if (is_wanted_[bucket] || (may_be_around && isAround (buckets[bucket])))
        for (std::size_t p = bucket * BUCKET; p < std::min ((bucket + 1) * BUCKET, cutter_.points);
             ++p)
          points_.push_back (static_cast<Index> (p));
  }
  for (std::size_t i = 0, end = 0; i < points_.size (); i = end) { // consecutive ones at a time
    for (end = i + 1; end < points_.size () && points_[end] == points_[end - 1] + 1;)
      ++end;
    cutter_.read (points_[i], points_[end - 1] + 1, positions_);
  }
}

Index
BlockSearch::placeOf (Index point) const
{
  return static_cast<Index> (std::lower_bound (points_.begin (), points_.end (), point) -
                             points_.begin ());
}

KdTree
BlockSearch::makeTree (const RunContext& run)
{
  KdTree tree (positions_, run, PointOrder::ALONG_CURVE);
  tree.watch = [this] (const Vector3d& centre, double radius) {
    const auto isHere = [&] (const Ball& ball) {
      return ((ball.centre - centre).norm () + radius) * ENLARGED <= ball.radius;
    };
    if (radius * ENLARGED <= halo_ || std::any_of (balls_.begin (), balls_.end (), isHere))
      return;
    const std::lock_guard<std::mutex> lock (mutex_);
    missing_.push_back ({centre, radius * ENLARGED * ENLARGED});
  };
  return tree;
}

bool
BlockSearch::widen ()
{
  if (missing_.empty ())
    return false;
  balls_.insert (balls_.end (), missing_.begin (), missing_.end ());
  missing_.clear ();
  cut ();
  return true;
}

} // namespace pcl::floater
