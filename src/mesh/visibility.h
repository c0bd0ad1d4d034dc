// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rays through a mesh, and what they see.
#pragma once

#include "core/parallel.h"
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

/// A line through a triangle.
struct SightLine
{
  Index triangle;
  Eigen::Vector3d middle;    ///< of the triangle
  Eigen::Vector3d direction; ///< towards its front
};

/// Chooses lines of sight, evenly over an area that is added triangle by triangle. Directions
/// follow Lambert's cosine law, so each counts by the apparent size of the surface. Deterministic:
/// a low-discrepancy sequence (Roberts 2018).
class SightLineSampler
{
public:
  /// \param area of all triangles that will be added, in any unit
  SightLineSampler (double area, std::size_t lines)
      : step_ (area / static_cast<double> (lines)), next_ (0.5 * step_)
  {
  }

  /// Appends the lines for this triangle: none, one, or several if it is large.
  /// \param normal of unit length
  void add (Index triangle, double area, const Eigen::Vector3d& middle,
            const Eigen::Vector3d& normal, std::vector<SightLine>& lines);

private:
  double step_, next_, sum_ = 0.0;
  std::size_t count_ = 0;
};

/// Whether a line is free towards each side.
struct Sight
{
  bool front = false, back = false;
};

/// \param blocks (line, triangle): whether that triangle counts; not called for the line's own one
template <typename Blocks>
std::vector<Sight>
look (const TriangleRays& rays, const std::vector<SightLine>& lines, Blocks&& blocks,
      const RunContext& run)
{
  constexpr std::size_t LINES_PER_TASK = 32;
  std::vector<Sight> sights (lines.size ());
  parallelTasks (run, (lines.size () + LINES_PER_TASK - 1) / LINES_PER_TASK,
                 [&] (std::size_t task) {
                   const std::size_t last = std::min (lines.size (), (task + 1) * LINES_PER_TASK);
                   for (std::size_t i = task * LINES_PER_TASK; i < last; ++i) {
                     const auto isFree = [&] (const Eigen::Vector3d& direction) {
                       bool is_free = true;
                       rays.forHits (lines[i].middle, direction, [&] (Index t, double) {
                         is_free = t == lines[i].triangle || !blocks (i, t);
                         return !is_free;
                       });
                       return is_free;
                     };
                     sights[i] = {isFree (lines[i].direction), isFree (-lines[i].direction)};
                   }
                 });
  return sights;
}

} // namespace pcl::floater
