// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Index types.
//
// There are three index spaces. A `cloud_index` is an index into the user's cloud, a `point` is a
// row of the working set, and an `unknown` is a row of the linear system.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl::floater {
using Index = std::uint32_t;
constexpr Index NONE = std::numeric_limits<Index>::max ();

/// Positions of points in space.
using Positions = std::vector<Eigen::Vector3d>;

/// Corners of a triangle, anti-clockwise seen from the front.
using Triangle = std::array<Index, 3>;

} // namespace pcl::floater
