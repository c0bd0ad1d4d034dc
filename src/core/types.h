// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The types that all stages share, and the headers of the standard library and of Eigen that most files
// use: others name only what they need beyond.
//
// There are three index spaces. A `cloud_index` is an index into the user's cloud, a `point` is a
// row of the working set, and an `unknown` is a row of the linear system.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace pcl::floater {
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

using Index = std::uint32_t;
constexpr Index NONE = std::numeric_limits<Index>::max ();

/// Positions of points in space.
using Positions = std::vector<Vector3d>;

/// Normals of points, of unit length unless stated.
using Normals = std::vector<Vector3f>;

/// Whether something is so, of each of several points, triangles or others: 1 or 0.
using Flags = std::vector<std::uint8_t>;

/// Corners of a triangle, anti-clockwise seen from the front.
using Triangle = std::array<Index, 3>;

/// The indices from 0 to count - 1.
inline std::vector<Index>
indicesBelow (std::size_t count)
{
  std::vector<Index> indices (count);
  std::iota (indices.begin (), indices.end (), Index{0});
  return indices;
}

} // namespace pcl::floater
