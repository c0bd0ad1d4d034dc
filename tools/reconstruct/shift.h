// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The origin that is subtracted from coordinates far from zero.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl::floater {
/// Where to move the origin so that 32-bit floats hold the coordinates well: the centre of the
/// bounding box of all finite points that are no gross outliers, rounded to the power of ten below
/// its diagonal. (0, 0, 0) if floats hold them well as they are: if the distance of two floats of
/// the size of the coordinates is below a hundredth of the spacing that the points would have on a
/// flat sheet as large as the box. O(n).
Eigen::Vector3d
chooseShift (const std::vector<Eigen::Vector3d>& positions, int threads);

} // namespace pcl::floater
