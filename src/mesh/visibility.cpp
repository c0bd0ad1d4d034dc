// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/visibility.h"

#include "core/geometry.h"
#include "mesh/vertex_stars.h"

#include <cmath>

namespace pcl::floater {
TriangleRays::TriangleRays (const std::vector<Triangle>& triangles,
                            const std::vector<Eigen::Vector3d>& positions, const RunContext& run)
    : triangles_ (triangles), positions_ (positions),
      order_ (orderByPoints (triangles, positions.size ())),
      tree_ ((order_.size () + GROUP - 1) / GROUP,
             [this] (std::size_t group) { return boxOf (group); }, run)
{
}

Eigen::AlignedBox3d
TriangleRays::boxOf (std::size_t group) const
{
  Eigen::AlignedBox3d box;
  for (std::size_t i = group * GROUP; i < std::min (order_.size (), (group + 1) * GROUP); ++i)
    for (const Index p : triangles_[order_[i]])
      box.extend (positions_[p]);
  return box;
}

// The ray hits if the volumes of the tetrahedra of ray and edges have one sign. Both triangles of
// an edge compute exactly opposite volumes, so no ray slips between them.
double
TriangleRays::hit (Index t, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const
{
  const Eigen::Vector3d a = positions_[triangles_[t][0]] - origin;
  const Eigen::Vector3d b = positions_[triangles_[t][1]] - origin;
  const Eigen::Vector3d c = positions_[triangles_[t][2]] - origin;
  const double ab = direction.dot (a.cross (b));
  const double bc = direction.dot (b.cross (c));
  const double ca = direction.dot (c.cross (a));
  const bool is_front = ab >= 0.0 && bc >= 0.0 && ca >= 0.0;
  if (!is_front && !(ab <= 0.0 && bc <= 0.0 && ca <= 0.0))
    return 0.0;
  const Eigen::Vector3d normal = areaVector (a, b, c);
  const double slope = direction.dot (normal);
  return slope != 0.0 ? std::max (0.0, a.dot (normal) / slope) : 0.0;
}

namespace {
// A unit vector around the normal, distributed by the cosine law: a point of the unit disc, lifted
// to the half sphere (Malley).
Eigen::Vector3d
directionAround (const Eigen::Vector3d& normal, std::size_t i)
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
} // namespace

void
SightLineSampler::add (Index triangle, double area, const Eigen::Vector3d& middle,
                       const Eigen::Vector3d& normal, std::vector<SightLine>& lines)
{
  sum_ += area;
  for (; next_ < sum_; next_ += step_)
    lines.push_back ({triangle, middle, directionAround (normal, count_++)});
}

} // namespace pcl::floater
