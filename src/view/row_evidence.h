// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether points lie in rows, as those of a line scanner.
#pragma once

#include "core/csr_lists.h"
#include "points/points.h"

#include <Eigen/Core>

namespace pcl::floater {
struct RowEvidence
{
  double share = 0.0; ///< share of points between their two nearest neighbours, on opposite sides
  Eigen::Vector3d across = Eigen::Vector3d::Zero (); ///< unit vector across the planes of the rows
  bool are_straight = true; ///< nearly all have one direction, so their planes are undetermined
};

/// \param row_of neighbours of a point, nearest first
/// \param count number of tested points, spread evenly over their order. O(count).
RowEvidence
findRows (const Points& points, const RowOf& row_of, std::size_t count);

} // namespace pcl::floater
