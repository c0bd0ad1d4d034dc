// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Projection of noisy points.
#pragma once

#include "points/noise.h"

namespace pcl::floater {
/// Projects every noisy point on the plane of up to 60 points around it within NoiseLimits::radius,
/// weighted by distance. A second pass leaves out points far off the first plane, such as
/// background behind an object. 3 microseconds for a noisy point.
/// \param neighbors of each point, nearest first
std::vector<Eigen::Vector3d>
projectNoisyPoints (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                    const Noise& noise, const NoiseLimits& limits, const RunContext& run);

} // namespace pcl::floater
