// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud as its sensor saw it: one ray for each point.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// Where a cloud was seen from.
struct Viewpoint
{
  /// The place of the sensor. If it is far away, a unit vector along the rays, which are parallel.
  Eigen::Vector3d place = Eigen::Vector3d::Zero ();
  bool is_far = false;
};

/// The ray from a viewpoint to a point.
struct Ray
{
  Eigen::Vector3d direction; ///< unit vector; of parallel rays, the foot of the point in the plane
                             ///< through the origin that the rays meet at right angles. Distances
                             ///< between directions are angles between rays, or distances.
                             ///< Zero if the point is the viewpoint itself
  double depth;              ///< along the ray
};

Ray
rayTo (const Eigen::Vector3d& position, const Viewpoint& viewpoint);

/// The rays to all points.
struct Rays
{
  std::vector<Eigen::Vector3d> directions; ///< see Ray
  std::vector<double> depths;              ///< see Ray
  std::vector<double> levels; ///< 1 / depth; of parallel rays, the depth. In a plane of
                              ///< space, the level is an affine function of the place
                              ///< where the ray meets any plane across the rays

  /// In the plane. Delaunay triangulations of these places are those of the rays: stereographic
  /// projection maps circles to circles. It leaves out a direction of the largest cone without
  /// rays, beyond which it is torn. Triangles that are anti-clockwise in the plane face the sensor.
  /// NaN for a point that is the viewpoint itself.
  std::vector<Eigen::Vector2d> places;
  bool are_parallel = false;
  Eigen::Vector3d parallel = Eigen::Vector3d::Zero (); ///< along parallel rays, unit length

  /// Angle between two rays, or distance between parallel ones.
  double distance (Index p, Index q) const { return (directions[p] - directions[q]).norm (); }
};

/// O(n).
Rays
makeRays (const std::vector<Eigen::Vector3d>& positions, const Viewpoint& viewpoint,
          const RunContext& run);

/// A plane across the ray of one point, in which the places of rays near it are measured from it.
class RayFrame
{
public:
  RayFrame (const Rays& rays, Index centre);

  /// Where the ray of a point meets the plane.
  Eigen::Vector2d operator() (Index point) const;

private:
  const Rays& rays_;
  Index centre_;
  Eigen::Vector3d x_ = Eigen::Vector3d::Zero (), y_ = Eigen::Vector3d::Zero ();
};

} // namespace pcl::floater
