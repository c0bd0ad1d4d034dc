// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest neighbours of consecutive points.
#pragma once

#include "points/kd_tree.h"

#include <vector>

namespace pcl::floater {
/// The k nearest points to points that mostly are near their predecessors, as along a space-filling
/// curve. Same result as KdTree::nearest, in less than half of the time: consecutive points share
/// the points of one ball, and the previous result bounds the distance of the next.
class SequentialSearch
{
public:
  /// \param tree, positions the tree, and the positions it was made from; must outlive this
  SequentialSearch (const KdTree& tree, const std::vector<Eigen::Vector3d>& positions,
                    std::size_t k)
      : tree_ (tree), positions_ (positions), k_ (k)
  {
  }

  /// Calls visit (i, found) for each of the points: `found` holds the k nearest to points[i],
  /// itself among them, nearest first; fewer if the tree holds fewer.
  template <typename Visit>
  void search (const std::vector<Index>& points, Visit&& visit)
  {
    for (std::size_t first = 0, last = 0; first < points.size (); first = last) {
      last = gatherBall (points, first);
      for (std::size_t i = first; i < last; ++i) {
        nearest (positions_[points[i]]);
        visit (i, found_);
      }
    }
  }

private:
  std::size_t gatherBall (const std::vector<Index>& points, std::size_t first);
  void nearest (const Eigen::Vector3d& query);
  bool searchBall (const Eigen::Vector3d& query, double reach);

  const KdTree& tree_;
  const std::vector<Eigen::Vector3d>& positions_;
  std::size_t k_;
  std::vector<Neighbor> found_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero (); // last query, and the distance to its last
                                                    // neighbour
  double last_reach_ = KdTree::EVERYWHERE;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero (); // of the ball
  double radius_ = -1.0;                              // of the ball; negative: there is none
  std::vector<Index> ball_;                           // points in the ball, and their coordinates
  std::vector<double> x_, y_, z_;
  std::vector<double> sqr_distances_; // of these to the query
  std::vector<Neighbor> near_;        // points within reach, unordered
};

} // namespace pcl::floater
