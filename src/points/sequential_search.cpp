// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/sequential_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl::floater {
namespace {
// Points that share a ball. Larger groups need fewer balls, with more points in each. On a height
// field, this and the next two were the fastest of five choices: 16 or 24 points, margins of 1.3 to
// 1.5, widths of 2 to 3. The slowest took a fifth more.
constexpr std::size_t GROUP = 24;

// Radius around each point of the group that the ball covers, relative to the distance of the last
// neighbour of the point before the group.
constexpr double MARGIN = 1.3;

// Largest width of a group, in such distances: beyond, the curve has jumped.
constexpr double WIDEST = 2.5;

// Maximum number of points in a ball for each neighbour. With the widths above it would be (WIDEST
// / 2 + MARGIN)^2, or 7, on a plane of even density; with many more, the density varies and the
// tree is faster.
constexpr std::size_t MOST_POINTS = 32;

// Expected bound of the distance to the last neighbour, relative to the previous point. If it
// fails, all points within reach are sorted. 1.15 took as long.
constexpr double EXPECTED = 1.1;

// Squares of shorter distances are imprecise. Coordinates are of the order of one.
constexpr double SHORTEST = 1e-140;

// Exceeds one by more than the rounding of a sum of distances.
constexpr double SAFELY = 1.0 + 1e-9;

// Sorts by distance, then point: first by counting in this many classes of the squared distance,
// which is evenly spread on surfaces, and then by insertion.
constexpr std::size_t CLASSES = 64;

void
sortInto (const std::vector<Neighbor>& some, std::size_t count, double sqr_reach,
          std::vector<Neighbor>& sorted)
{
  const double classes_per_distance = static_cast<double> (CLASSES - 1) / sqr_reach;
  const auto classOf = [classes_per_distance] (const Neighbor& neighbor) {
    return static_cast<std::size_t> (neighbor.sqr_distance * classes_per_distance);
  };
  std::array<std::uint32_t, CLASSES + 1> ends{};
  for (std::size_t i = 0; i < count; ++i)
    ++ends[classOf (some[i]) + 1];
  for (std::size_t c = 1; c <= CLASSES; ++c)
    ends[c] += ends[c - 1];
  sorted.resize (count);
  for (std::size_t i = 0; i < count; ++i)
    sorted[ends[classOf (some[i])]++] = some[i];
  for (std::size_t i = 1; i < count; ++i) {
    const Neighbor moved = sorted[i];
    std::size_t at = i;
    for (; at > 0 && moved < sorted[at - 1]; --at)
      sorted[at] = sorted[at - 1];
    sorted[at] = moved;
  }
}

} // namespace

// Gathers the points around a group that begins at `first`. Returns its end.
std::size_t
SequentialSearch::gatherBall (const std::vector<Index>& points, std::size_t first)
{
  radius_ = -1.0;
  const Eigen::Vector3d& begin = positions_[points[first]];
  if (last_reach_ == KdTree::EVERYWHERE) // none found yet
    nearest (begin);
  if (!(last_reach_ > SHORTEST) || last_reach_ == KdTree::EVERYWHERE)
    return first + 1;
  Eigen::AlignedBox3d box (begin);
  std::size_t last = first + 1;
  for (; last < std::min (points.size (), first + GROUP); ++last) {
    const Eigen::AlignedBox3d wider = box.merged (Eigen::AlignedBox3d (positions_[points[last]]));
    if (!(wider.diagonal ().norm () <= WIDEST * last_reach_))
      break;
    box = wider;
  }
  centre_ = box.center ();
  double farthest = 0.0;
  for (std::size_t i = first; i < last; ++i)
    farthest = std::max (farthest, (positions_[points[i]] - centre_).norm ());
  const double radius = farthest + MARGIN * last_reach_;
  if (!tree_.collect (centre_, radius, MOST_POINTS * k_, ball_))
    return last;
  radius_ = radius;
  x_.resize (ball_.size ());
  y_.resize (ball_.size ());
  z_.resize (ball_.size ());
  sqr_distances_.resize (ball_.size ());
  for (std::size_t i = 0; i < ball_.size (); ++i) {
    const Eigen::Vector3d& position = positions_[ball_[i]];
    x_[i] = position.x ();
    y_[i] = position.y ();
    z_[i] = position.z ();
  }
  return last;
}

void
SequentialSearch::nearest (const Eigen::Vector3d& query)
{
  // All neighbours of the last query are within this distance; so are as many points of the ball,
  // if it covers this distance. If not, a smaller ball may still contain enough.
  const double reach = (last_reach_ + (query - last_).norm ()) * SAFELY;
  const double inside = radius_ / SAFELY - (query - centre_).norm () * SAFELY;
  if (!searchBall (query, std::min (reach, inside)))
    tree_.nearest (query, k_, found_);
  last_ = query;
  last_reach_ =
      found_.size () == k_ && k_ > 0 ? std::sqrt (found_.back ().sqr_distance) : KdTree::EVERYWHERE;
}

// \return false if there are too few points within reach
bool
SequentialSearch::searchBall (const Eigen::Vector3d& query, double reach)
{
  if (!(reach > SHORTEST))
    return false;
  const std::size_t count = ball_.size ();
  for (std::size_t i = 0; i < count; ++i) {
    // The same sum as in the tree: the order of neighbours depends on the last bit.
    const double x = x_[i] - query.x (), y = y_[i] - query.y (), z = z_[i] - query.z ();
    sqr_distances_[i] = x * x + y * y + z * z;
  }
  near_.resize (count + 1);
  // The last neighbour is mostly about as far as for the previous query.
  for (const double within : {std::min (reach, EXPECTED * last_reach_), reach}) {
    const double sqr_reach = within * within;
    std::size_t near = 0;
    for (std::size_t i = 0; i < count; ++i) {
      near_[near] = {sqr_distances_[i], ball_[i]};
      near += sqr_distances_[i] <= sqr_reach ? 1 : 0;
    }
    if (near < k_)
      continue;
    sortInto (near_, near, sqr_reach, found_);
    found_.resize (k_);
    return true;
  }
  return false;
}

} // namespace pcl::floater
