// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes that are hard on a reconstruction.
#pragma once

#include "random_stream.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl::floater::fuzz {
/// Number of shapes that makeHardShape knows.
constexpr std::size_t HARD_SHAPES = 13;

/// Points on a shape, about 1 in size: a grid, a disc, a sphere, a line, a circle, random points,
/// coincident points, a hub of huge valence, sheets in contact, a box, a cone, a one-sided strip,
/// or a coarse depth image.
///
/// \param kind  0 to HARD_SHAPES - 1, in this order
/// \param count number of points
std::vector<Eigen::Vector3d>
makeHardShape (std::size_t kind, std::size_t count, RandomStream& random);

} // namespace pcl::floater::fuzz
