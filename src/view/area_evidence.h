// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How alike the solid angles of rays are, by the areas that points stand for.
#pragma once

#include "local/local_geometry.h"
#include "points/points.h"
#include "view/rays.h"

#include <vector>

namespace pcl::floater {
/// A point and the area that it stands for.
struct AreaSample
{
  Eigen::Vector3d position, normal;
  double area; ///< of its star, times six
};

/// Points that are spread evenly over the order of so many points, at most `2 * count`; ascending.
std::vector<Index>
areaSampleCentres (std::size_t points, std::size_t count);

/// The samples of some points, without those that have an open star. O(count).
/// \param stars the i-th is that of centres[i]
std::vector<AreaSample>
takeAreaSamples (const std::vector<Index>& centres, const std::vector<Eigen::Vector3d>& positions,
                 const Stars& stars, const RunContext& run);

/// Points that are spread evenly over the order of the points, at most `2 * count`; those with an
/// open star are left out. O(count).
/// \param settings of the stars
std::vector<AreaSample>
takeAreaSamples (const Points& points, const LocalPlanes& planes, const StarSettings& settings,
                 std::size_t count, const RunContext& run);

/// Logarithm of the ratio of the upper to the lower quartile.
/// \param[in,out] values at least one, all positive; their order changes
double
quartileSpread (std::vector<double>& values);

/// Spread of the solid angles of the samples as seen from a viewpoint: area, times the cosine
/// between normal and ray, over the squared distance.
/// \param angles room for as many numbers as there are samples
double
areaSpread (const std::vector<AreaSample>& samples, const Viewpoint& viewpoint,
            std::vector<double>& angles);

} // namespace pcl::floater
