// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A random body, as a function that is negative inside.
#pragma once

#include "random_stream.h"

#include <Eigen/Core>

#include <vector>

namespace pcl
{
namespace floater
{
class RandomBody
{
public:
  /// \param with_flat_faces boxes and drums among its parts
  RandomBody (bool with_flat_faces, RandomStream& random);

  /// About the distance to the surface, negative inside. The body lies within 1.5 of the origin.
  double distance (const Eigen::Vector3d& place) const;

  bool hasSharpSeams () const { return has_sharp_seams_; }

private:
  enum class Shape
  {
    BALL,
    CAPSULE,
    TORUS,
    ELLIPSOID,
    BOX,
    DRUM
  };

  struct Part
  {
    Shape shape = Shape::BALL;
    Eigen::Vector3d centre, size;
    Eigen::Matrix3d axes;
    bool is_taken_away = false;
    double seam = 0.0; // width of the blend with the parts before
  };

  static double distanceTo (const Part& part, const Eigen::Vector3d& place);

  std::vector<Part> parts_;
  double bump_height_ = 0.0, bump_frequency_ = 0.0;
  bool has_sharp_seams_ = false;
};

} // namespace floater
} // namespace pcl
