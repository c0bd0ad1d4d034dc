// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Evenly spread subsets of a cloud, for larger scales.
#pragma once

#include "points/kd_tree.h"

#include <array>
#include <utility>
#include <vector>

namespace pcl::floater {
/// Scales: every point, every fourth, every sixteenth. On a surface, spacings double from one to
/// the next.
constexpr std::size_t SCALES = 3;
constexpr std::array<std::size_t, SCALES> STRIDES{1, 4, 16};
constexpr std::size_t LOOKED_AT = 20; ///< neighbours at each scale

/// Every n-th point along the space-filling curve, so the sample is evenly spread.
class PointSample
{
public:
  PointSample (const std::vector<Eigen::Vector3d>& positions, std::size_t stride,
               const RunContext& run)
      : stride_ (stride), tree_ (every (positions, stride), run)
  {
  }

  /// Sample of a piece of a cloud: its points that are in the sample of the whole cloud, ascending.
  PointSample (const std::vector<Eigen::Vector3d>& positions, std::vector<Index> points,
               const RunContext& run)
      : points_ (std::move (points)), tree_ (at (positions, points_), run)
  {
  }

  /// See KdTree::setWatch.
  void setWatch (SearchWatch* watch) { tree_.setWatch (watch); }

  /// The nearest points of the sample, as indices among all points.
  void nearest (const Eigen::Vector3d& query, std::size_t k, std::vector<Neighbor>& found) const
  {
    tree_.nearest (query, k, found);
    tree_.lookedForNearest (query, k, found);
    for (Neighbor& neighbor : found)
      neighbor.point = points_.empty () ? neighbor.point * static_cast<Index> (stride_)
                                        : points_[neighbor.point];
  }

private:
  static std::vector<Eigen::Vector3d> every (const std::vector<Eigen::Vector3d>& positions,
                                             std::size_t stride)
  {
    std::vector<Eigen::Vector3d> kept;
    kept.reserve (positions.size () / stride + 1);
    for (std::size_t p = 0; p < positions.size (); p += stride)
      kept.push_back (positions[p]);
    return kept;
  }

  static std::vector<Eigen::Vector3d> at (const std::vector<Eigen::Vector3d>& positions,
                                          const std::vector<Index>& points)
  {
    std::vector<Eigen::Vector3d> kept;
    kept.reserve (points.size ());
    for (const Index p : points)
      kept.push_back (positions[p]);
    return kept;
  }

  std::size_t stride_ = 1;
  std::vector<Index> points_; // empty: every n-th
  KdTree tree_;
};

} // namespace pcl::floater
