// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Places along the Hilbert curve.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace pcl::floater {
/// Where a Hilbert curve through the box from -1/2 to 1/2 comes to the cell of a position.
std::uint64_t
hilbertCode (const Eigen::Vector3d& position);

/// The same for a curve within that cell: beside a piece many times as large, a whole object may lie
/// in a few cells.
std::uint64_t
hilbertCodeInCell (const Eigen::Vector3d& position);

} // namespace pcl::floater
