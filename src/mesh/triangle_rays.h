// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Intersections of rays and triangles.
#pragma once

#include "core/run_context.h"
#include "core/types.h"
#include "mesh/box_tree.h"

#include <vector>

namespace pcl::floater {
/// Triangles in a tree of boxes. About 12 bytes per triangle. O(n) to build, in parallel except for
/// the sorting. Rays may be cast by several threads.
class TriangleRays
{
public:
  /// \param triangles must outlive this, as must the positions
  TriangleRays (const std::vector<Triangle>& triangles,
                const std::vector<Eigen::Vector3d>& positions, const RunContext& run);

  /// Calls visit (t, at) for each triangle t that a ray meets beyond its origin, at origin + at *
  /// direction, unsorted, until it returns true. A ray through an edge or a corner meets at least
  /// one of the triangles around, and none that it is parallel to.
  /// \param direction not zero, any length
  template <typename Visit>
  void forHits (const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                Visit&& visit) const
  {
    tree_.forAlongRay (origin, direction, [&] (std::size_t group) {
      for (std::size_t i = group * GROUP; i < std::min (order_.size (), (group + 1) * GROUP); ++i) {
        const double at = hit (order_[i], origin, direction);
        if (at > 0.0 && visit (order_[i], at))
          return true;
      }
      return false;
    });
  }

private:
  // Triangles in one box of the tree: larger groups mean fewer boxes and more tests. Measured.
  static constexpr std::size_t GROUP = 4;

  Eigen::AlignedBox3d boxOf (std::size_t group) const;

  // Parameter of the intersection along the ray; 0 if there is none.
  double hit (Index t, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  const std::vector<Triangle>& triangles_;
  const std::vector<Eigen::Vector3d>& positions_;
  std::vector<Index> order_; // the triangles, by their smallest points
  BoxTree tree_;
};

} // namespace pcl::floater
