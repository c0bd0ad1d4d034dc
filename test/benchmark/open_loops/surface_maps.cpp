// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_maps.h"

#include <Eigen/Geometry>

#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
// Surfaces of one curvature radius.
Map
makeRoundMap (Shape shape, double radius)
{
  switch (shape) {
  case Shape::CYLINDER:
    return [radius] (const Place& p) {
      const double angle = p.x () / radius;
      return Eigen::Vector3d (radius * std::sin (angle), p.y (), radius * std::cos (angle));
    };
  case Shape::SPHERE:
    return [radius] (const Place& p) {
      const double angle = p.norm () / radius;
      const Place around = p.normalized () * radius * std::sin (angle);
      return Eigen::Vector3d (around.x (), around.y (), radius * std::cos (angle));
    };
  case Shape::SADDLE:
    return [radius] (const Place& p) {
      return Eigen::Vector3d (p.x (), p.y (), p.x () * p.y () / (2.0 * radius));
    };
  case Shape::TORUS:
    return [radius] (const Place& p) {
      const double tube = 0.5 * radius, angle = p.y () / tube, around = p.x () / (radius + tube);
      const double from_axis = radius + tube * std::cos (angle);
      return Eigen::Vector3d (from_axis * std::sin (around), tube * std::sin (angle),
                              from_axis * std::cos (around));
    };
  default:
    return [] (const Place& p) { return Eigen::Vector3d (p.x (), p.y (), 0.0); };
  }
}

// Random places, each at least the radius there away from all before it. \param tries per unit of
// area of the smallest radius

// Height fields of random waves, and a roof.
Map
makeUnevenMap (Shape shape, RandomStream& random)
{
  switch (shape) {
  case Shape::BUMPS: {
    const double length = logBetween (random, 15.0, 60.0);
    const double height = length * between (random, 0.02, 0.12);
    const Field bumps = waves (random, length, 2.0 * length);
    return [height, bumps] (const Place& p) {
      return Eigen::Vector3d (p.x (), p.y (), height * bumps (p));
    };
  }
  case Shape::TERRACES: {
    const double length = logBetween (random, 25.0, 80.0);
    const double height = length * between (random, 0.03, 0.12);
    const Field bumps = waves (random, length, 2.0 * length);
    return [height, bumps] (const Place& p) {
      return Eigen::Vector3d (p.x (), p.y (), height * std::tanh (4.0 * bumps (p)));
    };
  }
  case Shape::CLIFFS: {
    const double length = logBetween (random, 30.0, 80.0), steep = logBetween (random, 3.0, 12.0);
    const double height = logBetween (random, 3.0, 15.0);
    const Field bumps = waves (random, length, 2.0 * length);
    return [height, steep, bumps] (const Place& p) {
      return Eigen::Vector3d (p.x (), p.y (), height * std::tanh (steep * bumps (p)));
    };
  }
  case Shape::ROOF: {
    const double half_angle = 0.5 * PI * between (random, 0.3, 0.95);
    const double turn = 2.0 * PI * random.uniform ();
    const Eigen::Rotation2Dd rotation (turn);
    return [half_angle, rotation] (const Place& p) {
      const Place q = rotation * p;
      return Eigen::Vector3d (q.x () * std::sin (half_angle), q.y (),
                              -std::abs (q.x ()) * std::cos (half_angle));
    };
  }
  default: { // fins
    const double thick = logBetween (random, 1.0, 5.0), height = logBetween (random, 3.0, 12.0);
    const double length = logBetween (random, 30.0, 80.0);
    const Field bumps = waves (random, length, 2.0 * length);
    return [height, thick, length, bumps] (const Place& p) {
      const double across = bumps (p) * length / (2.0 * PI * thick);
      return Eigen::Vector3d (p.x (), p.y (), height * std::exp (-across * across));
    };
  }
  }
}

} // namespace

std::string
nameOf (Shape shape)
{
  const char* const names[] = {"plane", "cylinder", "sphere", "saddle", "torus",
                               "bumps", "terraces", "cliffs", "roof",   "fins"};
  return names[static_cast<std::size_t> (shape)];
}

Map
makeMap (Shape shape, double side, RandomStream& random)
{
  const double radius = side * logBetween (random, 0.5, 3.0);
  switch (shape) {
  case Shape::BUMPS:
  case Shape::TERRACES:
  case Shape::CLIFFS:
  case Shape::ROOF:
  case Shape::FINS:
    return makeUnevenMap (shape, random);
  default:
    return makeRoundMap (shape, radius);
  }
}

} // namespace floater
} // namespace pcl
