// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates in a tangent plane.
#pragma once

#include <Eigen/Geometry>

namespace pcl::floater {
/// Right-handed axes with the normal as the third.
struct TangentFrame
{
  explicit TangentFrame (const Eigen::Vector3d& unit_normal)
      : normal (unit_normal), x (unit_normal.unitOrthogonal ()), y (unit_normal.cross (x))
  {
  }

  Eigen::Vector2d project (const Eigen::Vector3d& offset) const
  {
    return {x.dot (offset), y.dot (offset)};
  }

  Eigen::Vector3d normal, x, y;
};

} // namespace pcl::floater
