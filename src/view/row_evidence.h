// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a cloud was scanned along lines, and in which planes these lie.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/points.h"

namespace pcl
{
namespace floater
{
struct RowEvidence
{
  double share =
      0.0; ///< of points between their two nearest neighbors, which lie to opposite sides
  Eigen::Vector3d across = Eigen::Vector3d::Zero (); ///< unit vector across the planes of the rows
  bool are_straight = true; ///< all rows run along one direction, so that they do not tell planes
};

/// \param neighbors nearest first
/// \param count number of points that are looked at, spread evenly over their order. O(count).
RowEvidence
findRows (const Points& points, const CsrLists& neighbors, std::size_t count,
          const RunContext& run);

} // namespace floater
} // namespace pcl
