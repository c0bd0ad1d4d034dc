// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_cost.h"

#include <Eigen/Geometry>

namespace pcl
{
namespace floater
{
namespace
{
constexpr double TURNED = 0.2; // cosine to the corners' normals below which a triangle is penalized
constexpr double PENALTY = 1000.0;   // per unit of that cosine; a right isosceles triangle costs 2
constexpr double LARGE = 3.0;        // doubled area, in squared spacings, that is not penalized
constexpr double LARGE_COST = 100.0; // per squared spacing beyond

} // namespace

TriangleCost::Value
TriangleCost::value (Index a, Index b, Index c) const
{
  // The smallest point first, so that nothing depends, not even by rounding, on where a triangle
  // begins: flips could go round in circles otherwise.
  if (b < a && b < c)
    return value (b, c, a);
  if (c < a && c < b)
    return value (c, a, b);
  const Eigen::Vector3d ab = positions_[b] - positions_[a];
  const Eigen::Vector3d ac = positions_[c] - positions_[a];
  const Eigen::Vector3d bc = positions_[c] - positions_[b];
  const Eigen::Vector3d area_vector = ab.cross (ac);
  const double double_area = area_vector.norm ();
  const double sqr_lengths = ab.squaredNorm () + ac.squaredNorm () + bc.squaredNorm ();
  // cot A + cot B + cot C = (a^2 + b^2 + c^2) / (4 area); bounded, so that costs of needles
  // compare.
  const double cotangents = sqr_lengths / (2.0 * std::max (double_area, 1e-9 * sqr_lengths));
  const double turned =
      PENALTY * std::max (0.0, TURNED - agreement (a, b, c, area_vector, double_area));
  Value result{area_vector, cotangents + turned};
  if (double_area > 0.0)
    result.unit_normal /= double_area;
  if (spacing_ != nullptr) {
    const double spacing = ((*spacing_)[a] + (*spacing_)[b] + (*spacing_)[c]) / 3.0;
    result.cost += LARGE_COST * std::max (0.0, double_area / (spacing * spacing) - LARGE);
  }
  return result;
}

double
TriangleCost::agreement (Index a, Index b, Index c, const Eigen::Vector3d& area_vector,
                         double double_area) const
{
  const Eigen::Vector3f normal = normals_[a] + normals_[b] + normals_[c];
  const double length = normal.norm () * double_area;
  return length > 0.0 ? normal.cast<double> ().dot (area_vector) / length : 0.0;
}

bool
TriangleCost::isTurned (const Triangle& corners) const
{
  const auto [a, b, c] = corners;
  const Eigen::Vector3d area_vector =
      (positions_[b] - positions_[a]).cross (positions_[c] - positions_[a]);
  return agreement (a, b, c, area_vector, area_vector.norm ()) < TURNED;
}

} // namespace floater
} // namespace pcl
