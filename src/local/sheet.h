// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a neighbour lies on the same sheet of the surface.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace pcl::floater {
/// Thresholds that separate sheets. Chosen on the clouds of the first benchmark: wide enough for
/// sharp edges of 90 degrees; unreliable for thin sheets.
struct SheetLimits
{
  double plane_sine = 0.75;   ///< of the angle, 49 degrees, between a tangent plane and a neighbour
  double normal_cosine = 0.3; ///< of the angle, 72 degrees, between normals
};

/// True if a neighbour at `offset` lies within the limits of both tangent planes, and the unsigned
/// normals agree.
inline bool
onSameSheet (const Eigen::Vector3d& normal, const Eigen::Vector3d& other_normal,
             const Eigen::Vector3d& offset, const SheetLimits& limits)
{
  const double limit = limits.plane_sine * offset.norm ();
  return std::abs (normal.dot (offset)) <= limit && std::abs (other_normal.dot (offset)) <= limit &&
         std::abs (normal.dot (other_normal)) >= limits.normal_cosine;
}

} // namespace pcl::floater
