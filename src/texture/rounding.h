// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of a texture that rounding to single precision has flipped.
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// Moves corners of triangles that do not run anti-clockwise, by a few steps of single precision,
/// where that makes more of the triangles around them run so. Decided exactly. O(triangles) where
/// there are none. One thread, always in the same order.
/// \param         triangles corners as places in uv
/// \param[in,out] uv        in the unit square, and afterwards
/// \return triangles that do not run anti-clockwise still
std::size_t
repairRounding (const std::vector<Triangle>& triangles, std::vector<Eigen::Vector2f>& uv);

} // namespace pcl::floater
