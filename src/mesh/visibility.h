// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rays through a mesh, and what they see.
#pragma once

#include "core/geometry.h"
#include "mesh/box_tree.h"
#include "mesh/self_intersections.h"
#include "mesh/vertex_stars.h"

namespace pcl::floater {
/// Triangles in a tree of boxes. About 32 bytes per triangle. O(n) to build, in parallel except for
/// the sorting. Rays may be cast by several threads.
class TriangleRays
{
public:
  /// \param triangles must outlive this, as must the positions
  TriangleRays (const std::vector<Triangle>& triangles, const Positions& positions,
                const RunContext& run)
      : triangles_ (triangles), positions_ (positions),
        order_ (orderByPoints (triangles, positions.size ())),
        tree_ (
            order_.size (),
            [this] (std::size_t i) { return boxOf (triangles_[order_[i]], positions_); }, run)
  {
  }

  /// Calls visit (t) for each triangle t that a ray meets beyond its origin, unsorted, until it
  /// returns true. A ray through an edge or a corner meets at least one of the triangles around, and
  /// none that it is parallel to.
  /// \param direction not zero, any length
  /// \return whether it has
  template <typename Visit>
  bool forHits (const Vector3d& origin, const Vector3d& direction, Visit&& visit) const
  {
    return tree_.forAlongRay (origin, direction, [&] (std::size_t i) {
      return isHit (order_[i], origin, direction) && visit (order_[i]);
    });
  }

private:
  // The ray hits if the volumes of the tetrahedra of ray and edges have one sign. Both triangles of an
  // edge compute exactly opposite volumes, so no ray slips between them.
  bool isHit (Index t, const Vector3d& origin, const Vector3d& direction) const
  {
    const Vector3d a = positions_[triangles_[t][0]] - origin;
    const Vector3d b = positions_[triangles_[t][1]] - origin;
    const Vector3d c = positions_[triangles_[t][2]] - origin;
    const double ab = direction.dot (a.cross (b));
    const double bc = direction.dot (b.cross (c));
    const double ca = direction.dot (c.cross (a));
    const bool is_front = ab >= 0.0 && bc >= 0.0 && ca >= 0.0;
    if (!is_front && !(ab <= 0.0 && bc <= 0.0 && ca <= 0.0))
      return false;
    const Vector3d normal = areaVector (a, b, c);
    const double slope = direction.dot (normal);
    return slope != 0.0 && a.dot (normal) / slope > 0.0;
  }

  const std::vector<Triangle>& triangles_;
  const Positions& positions_;
  std::vector<Index> order_; // the triangles, by their smallest points
  BoxTree tree_;
};

/// A line through a triangle.
struct SightLine
{
  Index triangle;
  Vector3d middle;    ///< of the triangle
  Vector3d direction; ///< towards its front
};

/// Chooses lines of sight, evenly over an area that is added triangle by triangle. Directions
/// follow Lambert's cosine law, so each counts by the apparent size of the surface. Deterministic:
/// a low-discrepancy sequence (Roberts 2018).
class SightLineSampler
{
public:
  /// \param area of all triangles that will be added, in any unit; and their number
  SightLineSampler (double area, std::size_t triangles)
  {
    // Through an object: with the most lines, shares have a standard deviation of 0.02. Smaller ones
    // get fewer lines, but at least some. Both limit the time.
    constexpr std::size_t MOST = 512, TRIANGLES_PER_LINE = 8, FEWEST = 64;
    step_ = area / static_cast<double> (std::clamp (triangles / TRIANGLES_PER_LINE, FEWEST, MOST));
    next_ = 0.5 * step_;
  }

  /// Appends the lines for this triangle: none, one, or several if it is large.
  /// \param normal of unit length
  void add (Index triangle, double area, const Vector3d& middle, const Vector3d& normal,
            std::vector<SightLine>& lines)
  {
    sum_ += area;
    for (; next_ < sum_; next_ += step_)
      lines.push_back ({triangle, middle, directionAround (normal, count_++)});
  }

private:
  // A unit vector around the normal: a point of the unit disc, lifted to the half sphere (Malley).
  static Vector3d directionAround (const Vector3d& normal, std::size_t i)
  {
    // Powers of the inverse of the plastic number, the root of x^3 = x + 1.
    constexpr double FIRST = 0.7548776662466927, SECOND = 0.5698402909980532;
    const auto fraction = [] (double x) { return x - std::floor (x); };
    const double sqr_radius = fraction (FIRST * static_cast<double> (i + 1));
    const double angle = 2.0 * PI * fraction (SECOND * static_cast<double> (i + 1));
    const TangentFrame frame (normal);
    const double radius = std::sqrt (sqr_radius);
    return radius * std::cos (angle) * frame.x + radius * std::sin (angle) * frame.y +
           std::sqrt (1.0 - sqr_radius) * normal;
  }

  double step_ = 0.0, next_ = 0.0, sum_ = 0.0;
  std::size_t count_ = 0;
};

} // namespace pcl::floater
