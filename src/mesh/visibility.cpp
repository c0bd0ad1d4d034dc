// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/visibility.h"

#include "core/geometry.h"
#include "core/tangent_frame.h"

#include <cmath>

namespace pcl::floater {
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
