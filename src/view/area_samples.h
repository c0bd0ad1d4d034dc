// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Patches around some points, and their areas, which a scanner sees under the same solid angle.
#pragma once

#include "core/csr_lists.h"
#include "view/ray_evidence.h"

#include <vector>

namespace pcl::floater {
/// Patches around points that are spread evenly over their order, over their neighbours: also across
/// rows that are far apart. Parallel rays to a patch are near each other for any direction.
/// \param row_of neighbours of a point, nearest first
/// \param size points of a patch; fewer if there are no more around
/// \return the points of each patch, sorted by distance to the first one
std::vector<RayPatch>
findPointPatches (const std::vector<Eigen::Vector3d>& positions, const RowOf& row_of,
                  std::size_t count, std::size_t size);

/// A point and the area around it.
struct AreaSample
{
  Eigen::Vector3d position, normal;
  double area; ///< of the patch around it, in any unit
};

/// Area samples of patches of points: noise and rows spoil the stars of single points. O(count).
/// \param row_of see findPointPatches
std::vector<AreaSample>
takePatchSamples (const std::vector<Eigen::Vector3d>& positions, const RowOf& row_of,
                  std::size_t count);

/// Logarithm of the ratio of the upper to the lower quartile.
/// \param[in,out] values at least one, all positive; their order changes
double
quartileSpread (std::vector<double>& values);

/// Spread of the solid angles of the samples from a viewpoint: area, times the cosine between
/// normal and ray, over the squared distance.
/// \param angles scratch, one for each sample
double
areaSpread (const std::vector<AreaSample>& samples, const Viewpoint& viewpoint,
            std::vector<double>& angles);

} // namespace pcl::floater
