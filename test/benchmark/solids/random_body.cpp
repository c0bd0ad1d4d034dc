// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_body.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
double
between (RandomStream& random, double low, double high)
{
  return low + (high - low) * random.uniform ();
}

Eigen::Vector3d
inCube (RandomStream& random, double half_side)
{
  const double x = between (random, -half_side, half_side);
  const double y = between (random, -half_side, half_side);
  return {x, y, between (random, -half_side, half_side)};
}

Eigen::Matrix3d
randomAxes (RandomStream& random)
{
  Eigen::Vector4d q;
  for (double& x : q)
    x = random.normal ();
  return Eigen::Quaterniond (q.normalized ()).toRotationMatrix ();
}

} // namespace

RandomBody::RandomBody (bool with_flat_faces, RandomStream& random)
{
  const std::size_t count = 2 + random.below (6);
  has_sharp_seams_ = random.below (3) == 0;
  for (std::size_t i = 0; i < count; ++i) {
    Part part;
    part.shape = static_cast<Shape> (random.below (with_flat_faces ? 6 : 4));
    part.centre = i == 0 ? Eigen::Vector3d::Zero () : inCube (random, 0.6);
    part.axes = randomAxes (random);
    const double size = between (random, 0.15, 0.5);
    const double second = between (random, 0.15, 1.0);
    part.size = {size, size * second, size * between (random, 0.15, 1.0)};
    if (part.shape == Shape::BALL)
      part.size[0] = 0.8 * size;
    if (part.shape == Shape::TORUS) // at most 0.4 of its radius thick
      part.size[1] = size * (0.12 + 0.28 * second);
    if (part.shape == Shape::CAPSULE)
      part.size[1] = std::max (0.05, 0.5 * size * second);
    part.is_taken_away = i > 0 && random.below (4) == 0;
    part.seam = has_sharp_seams_ ? 0.002 : between (random, 0.02, 0.15);
    parts_.push_back (part);
  }
  bump_height_ = random.below (2) == 0 ? 0.0 : between (random, 0.0, 0.02);
  bump_frequency_ = between (random, 5.0, 25.0);
}

double
RandomBody::distanceTo (const Part& part, const Eigen::Vector3d& place)
{
  const Eigen::Vector3d at = part.axes * (place - part.centre);
  const Eigen::Vector3d& size = part.size;
  const double across = std::hypot (at.x (), at.y ());
  switch (part.shape) {
  case Shape::BALL:
    return at.norm () - size[0];
  case Shape::CAPSULE:
    return (at - std::clamp (at.x (), -size[0], size[0]) * Eigen::Vector3d::UnitX ()).norm () -
           size[1];
  case Shape::TORUS:
    return std::hypot (across - size[0], at.z ()) - size[1];
  case Shape::ELLIPSOID:
    return (at.cwiseQuotient (size).norm () - 1.0) * size.minCoeff ();
  case Shape::BOX: {
    const Eigen::Vector3d beyond = at.cwiseAbs () - size;
    return beyond.cwiseMax (0.0).norm () + std::min (beyond.maxCoeff (), 0.0);
  }
  case Shape::DRUM: {
    const double beside = across - size[0], above = std::abs (at.z ()) - size[1];
    return std::min (std::max (beside, above), 0.0) +
           std::hypot (std::max (beside, 0.0), std::max (above, 0.0));
  }
  }
  return 0.0;
}

double
RandomBody::distance (const Eigen::Vector3d& place) const
{
  double distance = distanceTo (parts_.front (), place);
  for (std::size_t i = 1; i < parts_.size (); ++i) {
    // The smaller one, or the larger one of the complement, with a quadratic blend between.
    const Part& part = parts_[i];
    const double sign = part.is_taken_away ? -1.0 : 1.0;
    const double other = sign * distanceTo (part, place);
    const double blend = std::max (part.seam - std::abs (distance - other), 0.0) / part.seam;
    distance = (part.is_taken_away ? std::max (distance, other) : std::min (distance, other)) -
               sign * blend * blend * part.seam / 4.0;
  }
  const Eigen::Vector3d phase = bump_frequency_ * place + Eigen::Vector3d (0.0, 1.0, 2.0);
  return distance + bump_height_ * phase.array ().sin ().prod ();
}

} // namespace floater
} // namespace pcl
