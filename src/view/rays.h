// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rays from the sensor to the points of a cloud.
#pragma once

#include "core/run_context.h"
#include "core/types.h"

#include <Eigen/Core>

#include <vector>

namespace pcl::floater {
/// Viewpoint of a cloud.
struct Viewpoint
{
  /// Position of the sensor. If it is far away: unit vector along the parallel rays.
  Eigen::Vector3d place = Eigen::Vector3d::Zero ();
  bool is_far = false;
  bool is_only_told = false; ///< by the file; the points do not tell
};

/// The ray from a viewpoint to a point.
struct Ray
{
  Eigen::Vector3d direction; ///< unit vector; for parallel rays, the projection of the point on the
                             ///< plane through the origin perpendicular to the rays. Distances
                             ///< between directions approximate angles, or are distances. Zero if
                             ///< the point is the viewpoint
  double depth;              ///< along the ray
};

Ray
rayTo (const Eigen::Vector3d& position, const Viewpoint& viewpoint);

/// A direction in the widest of the cones without rays, of those around evenly spread directions.
/// \param positions some 2000 of them are looked at
/// \param[out] cosine of the angle to the nearest ray
Eigen::Vector3d
emptyDirection (const std::vector<Eigen::Vector3d>& positions, const Viewpoint& viewpoint,
                std::size_t tries, double& cosine);

/// The rays to all points.
struct Rays
{
  std::vector<Eigen::Vector3d> directions; ///< see Ray
  std::vector<double> depths;              ///< see Ray
  std::vector<double> levels; ///< inverse depths; for parallel rays, depths. In a plane in space,
                              ///< they are affine functions of the position where the ray meets any
                              ///< plane across the rays

  /// Projected rays in the plane: stereographic projection maps circles to circles, so their
  /// Delaunay triangulation is that of the rays. The pole is a direction in the largest cone
  /// without rays. Anti-clockwise triangles face the sensor. NaN for a point that is the viewpoint.
  std::vector<Eigen::Vector2d> places;
  bool are_parallel = false;
  Eigen::Vector3d parallel = Eigen::Vector3d::Zero (); ///< along parallel rays, unit length

  /// Angle between two rays, or distance between parallel ones.
  double distance (Index p, Index q) const { return (directions[p] - directions[q]).norm (); }

  /// Where the ray of q meets a plane across the ray of p, from that point of p.
  Eigen::Vector2d placeBeside (Index p, Index q) const;
};

/// O(n).
Rays
makeRays (const std::vector<Eigen::Vector3d>& positions, const Viewpoint& viewpoint,
          const RunContext& run);

/// Points of a patch of rays, sorted by the angle to the first ray.
using RayPatch = std::vector<Index>;

/// The rays to the points of a patch, in single precision relative to the first one, which keeps
/// six digits of their small distances.
class PatchRays
{
public:
  PatchRays (const std::vector<Eigen::Vector3d>& positions, const RayPatch& patch,
             const Viewpoint& viewpoint);

  /// The neighbours of one ray, as indices in the patch; its own index if there is none.
  struct Neighbors
  {
    std::size_t nearest; ///< the nearest ray
    std::size_t across;  ///< the nearest one more than 45 degrees off the direction to `nearest`:
                         ///< in a scanner's raster, in the next row
    float nearest_distance, second_distance; ///< to the nearest two; infinite if there is none
    float across_distance;                   ///< to `across`; 0 if there is none
  };

  /// O(points of the patch).
  /// \param with_across false: `across` is not searched
  Neighbors neighborsOf (std::size_t ray, bool with_across = true);

private:
  Eigen::ArrayXf x_, y_, z_;
  Eigen::ArrayXf sqr_distances_; // to the current ray
};

} // namespace pcl::floater
