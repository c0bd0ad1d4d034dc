// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_directions.h"

#include "core/geometry.h"

namespace pcl::floater::facing_cases {
double
between (RandomStream& random, double low, double high)
{
  return low + (high - low) * random.uniform ();
}

Eigen::Vector3d
randomDirection (RandomStream& random)
{
  return Eigen::Vector3d (random.normal (), random.normal (), random.normal ()).normalized ();
}

Eigen::Matrix3d
randomRotation (RandomStream& random)
{
  return Eigen::Quaterniond (random.normal (), random.normal (), random.normal (), random.normal ())
      .normalized ()
      .toRotationMatrix ();
}

Eigen::Matrix3d
randomTilt (RandomStream& random, double degrees)
{
  const Eigen::AngleAxisd around (between (random, 0.0, 2.0 * PI), Eigen::Vector3d::UnitZ ());
  const Eigen::AngleAxisd tilt (
      between (random, 0.0, degrees * DEGREE),
      Eigen::Vector3d (random.normal (), random.normal (), 0.0).normalized ());
  return (tilt * around).toRotationMatrix ();
}

} // namespace pcl::floater::facing_cases
