// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The rays of a patch, and which of them are neighbours.
#pragma once

#include "view/rays.h"

#include <Eigen/Core>

#include <vector>

namespace pcl::floater {
/// Points at nearby rays: the nearest rays to that of a point, nearest first.
using RayPatch = std::vector<Index>;

/// The rays to the points of a patch, in single precision about the first one. The rays of a patch
/// are near each other, so that their distances keep six digits.
class PatchRays
{
public:
  PatchRays (const std::vector<Eigen::Vector3d>& positions, const RayPatch& patch,
             const Viewpoint& viewpoint);

  /// The neighbours of one ray, by their numbers in the patch; its own where there is none.
  struct Neighbors
  {
    std::size_t nearest; ///< the nearest ray
    std::size_t across;  ///< the nearest one that lies across the direction to `nearest`: by more
                         ///< than 45 degrees. In a scanner's raster, it is in the next row
    float nearest_distance, second_distance; ///< to the nearest two; infinite if there is none
    float across_distance;                   ///< to `across`; 0 if there is none
  };

  /// O(points of the patch).
  /// \param with_across false: `across` is not searched
  Neighbors neighborsOf (std::size_t ray, bool with_across = true);

private:
  Eigen::ArrayXf x_, y_, z_;
  Eigen::ArrayXf sqr_distances_; // to the ray whose neighbours are searched
};

} // namespace pcl::floater
