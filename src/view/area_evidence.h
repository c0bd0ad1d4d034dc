// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Evenness of the solid angles of rays, from the areas around the points.
#pragma once

#include "local/local_geometry.h"
#include "points/points.h"
#include "view/rays.h"

#include <vector>

namespace pcl::floater {
/// A point and the area around it.
struct AreaSample
{
  Eigen::Vector3d position, normal;
  double area; ///< of its star, times six
};

/// At most `2 * count` points, spread evenly over the order of the points; ascending.
std::vector<Index>
areaSampleCentres (std::size_t points, std::size_t count);

/// The samples of some points, except those with an open star. O(count).
/// \param stars the i-th belongs to centres[i]
std::vector<AreaSample>
takeAreaSamples (const std::vector<Index>& centres, const std::vector<Eigen::Vector3d>& positions,
                 const Stars& stars, const RunContext& run);

/// Area samples at at most `2 * count` points, spread evenly over their order, except those with an
/// open star. O(count).
/// \param settings of the stars
std::vector<AreaSample>
takeAreaSamples (const Points& points, const LocalPlanes& planes, const StarSettings& settings,
                 std::size_t count, const RunContext& run);

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
