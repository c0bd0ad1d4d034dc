// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours and tangent planes by PCL's own kd-tree and normal estimation, for TW 385 as built from
// PCL. The core's own are faster and use all threads. Both copy the points, in single precision.
#pragma once

#include <pcl/surface/floater/reconstruct.h>

#include <memory>

namespace pcl::floater {
/// pcl::search::KdTree as a search method for the core.
std::unique_ptr<NeighborSearch>
makePclSearch (const Input& input);

/// For each point of the whole cloud, by pcl::NormalEstimation: normal of the plane through it and
/// its k nearest; NaN for points that are not selected or not finite.
std::vector<Eigen::Vector3f>
estimateNormals (const Input& input, int k);

} // namespace pcl::floater
