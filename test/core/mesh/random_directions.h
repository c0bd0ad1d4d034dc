// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers and directions of the generated meshes.
#pragma once

#include "random_stream.h"

#include <Eigen/Geometry>

namespace pcl::floater::facing_cases {
double
between (RandomStream& random, double low, double high);

/// A unit vector, all directions alike.
Eigen::Vector3d
randomDirection (RandomStream& random);

/// All rotations alike.
Eigen::Matrix3d
randomRotation (RandomStream& random);

/// Around z by any angle, then tilted by up to some degrees.
Eigen::Matrix3d
randomTilt (RandomStream& random, double degrees);

} // namespace pcl::floater::facing_cases
