// SPDX-License-Identifier: GPL-3.0-or-later
// Exact nearest neighbours among points in space.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// A neighbour and its squared distance. Ordered by distance, then index.
struct Neighbor
{
  double sqr_distance;
  Index point;

  bool operator<(const Neighbor& other) const
  {
    return sqr_distance != other.sqr_distance ? sqr_distance < other.sqr_distance
                                              : point < other.point;
  }
};

/// kd-tree with buckets at its leaves. Built by medians: O(n log n), 40 bytes per point, the same
/// for any number of threads. Queries are exact, ties in distance are broken by index, and any
/// number of threads may query at once.
class KdTree
{
public:
  explicit KdTree (const std::vector<Eigen::Vector3d>& positions, const RunContext& run = 1);

  /// The k nearest points to `query`, nearest first; fewer if the tree holds fewer. The result is
  /// overwritten. O(k + log n) on clouds of bounded density.
  void nearest (const Eigen::Vector3d& query, std::size_t k, std::vector<Neighbor>& result) const;

  /// All points within `radius` of `query` (that distance included), nearest first.
  void within (const Eigen::Vector3d& query, double radius, std::vector<Neighbor>& result) const;

private:
  struct Node
  {
    double split; // coordinate of the plane between the children
    Index first;  // of the points below this node
    Index last;   // one past
    Index right;  // the left child is the next node; NONE at a leaf
    std::uint8_t axis;
  };
  struct Item
  {
    Eigen::Vector3d position;
    Index point;
  };
  template <typename Visit>
  void search (Index node, const Eigen::Vector3d& query, Eigen::Vector3d& sqr_offsets,
               double sqr_box_distance, Visit& visit) const;
  void build (Index first, Index last, const RunContext& run, std::vector<Node>& nodes);

  std::vector<Item> items_; // in the order of the leaves
  std::vector<Node> nodes_;
};

} // namespace floater
} // namespace pcl
