// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbouring rays in a patch.
#pragma once

#include "view/rays.h"

#include <Eigen/Core>

#include <vector>

namespace pcl::floater {
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
