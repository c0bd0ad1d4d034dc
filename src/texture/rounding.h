// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Repairs triangles of a texture that are flipped by rounding to single precision.
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// Moves corners of flipped triangles by a few steps of single precision, if this reduces the
/// flipped triangles around them. Exact tests. O(triangles) if there are none. One thread,
/// deterministic.
/// \param         triangles corners as indices of uv
/// \param[in,out] uv        in the unit square, and afterwards
/// \return number of triangles that are still flipped
std::size_t
repairRounding (const std::vector<Triangle>& triangles, std::vector<Eigen::Vector2f>& uv);

} // namespace pcl::floater
