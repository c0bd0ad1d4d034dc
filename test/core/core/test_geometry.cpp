// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
// Whether normals at this angle, in degrees, make a fold. Expects the same for any lengths.
bool
isFoldAt (double angle)
{
  const Eigen::Vector3d axis = Eigen::Vector3d (1.0, -2.0, 0.5).normalized ();
  const Eigen::Vector3d normal = axis.unitOrthogonal ();
  const Eigen::Vector3d other = Eigen::AngleAxisd (angle * DEGREE, axis) * normal;
  const bool is_fold = isFold (normal, other);
  for (const double length : {1e-60, 1e-9, 3.0, 1e60})
    for (const double other_length : {1e-60, 0.7, 1e60}) {
      EXPECT_EQ (isFold (length * normal, other_length * other), is_fold) << length;
      EXPECT_EQ (isFold (other_length * other, length * normal), is_fold) << length;
    }
  return is_fold;
}

TEST (IsFold, FromOneHundredAndTwentyDegreesOn)
{
  for (const double flat : {0.0, 30.0, 60.0, 61.0, 90.0, 119.0, 119.999})
    EXPECT_FALSE (isFoldAt (flat)) << flat;
  for (const double folded : {120.001, 121.0, 150.0, 180.0})
    EXPECT_TRUE (isFoldAt (folded)) << folded;
}

TEST (IsFold, NotWithoutArea)
{
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero (), up = Eigen::Vector3d::UnitZ ();
  EXPECT_FALSE (isFold (zero, up));
  EXPECT_FALSE (isFold (-up, zero));
  EXPECT_FALSE (isFold (zero, zero));
  // Three points on a line make a triangle without area.
  EXPECT_FALSE (isFold (areaVector ({0, 0, 0}, {1, 1, 1}, {3, 3, 3}), up));
}

TEST (Cross, IsTwiceTheAreaWithItsSign)
{
  EXPECT_EQ (cross (Eigen::Vector2d (2, 0), Eigen::Vector2d (5, 3)), 6.0) << "to the left";
  EXPECT_EQ (cross (Eigen::Vector2d (5, 3), Eigen::Vector2d (2, 0)), -6.0) << "to the right";
  EXPECT_EQ (cross (Eigen::Vector2d (2, -1), Eigen::Vector2d (-6, 3)), 0.0);
}

TEST (AreaVector, PointsToTheSideFromWhichCornersRunAnticlockwise)
{
  EXPECT_EQ (areaVector ({1, 1, 5}, {3, 1, 5}, {1, 4, 5}), Eigen::Vector3d (0, 0, 6));
  EXPECT_EQ (areaVector ({1, 1, 5}, {1, 4, 5}, {3, 1, 5}), Eigen::Vector3d (0, 0, -6));
}

} // namespace
} // namespace pcl::floater
