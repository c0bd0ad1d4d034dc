// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points that lie on one another: a well-spaced subset is connected first.
#pragma once

#include "points/neighbors.h"
#include "points/points.h"

namespace pcl::floater {
/// Points set aside: first and last returns of a laser on hard ground, overlapping strips, merged
/// scans, apart along the normal by a few percent of the spacing.
struct Stacks
{
  std::size_t points = 0; ///< number of points
  double median = 0.0;    ///< of their distances to the net, in its local spacings
  double largest = 0.0;   ///< of these
  Index at = NONE;        ///< point of the net where it is
};

/// Leaves a net in the working set: sets points aside until none is nearer to another than the gap,
/// in the spacing of the net itself. The first along the curve stay, so the result depends on no
/// order of the input and no number of threads. Each point of the net then is at the mean of itself
/// and those that it stands for (see Points::stacked). A search of neighbours for each round, 1 to 4
/// of them.
/// \param[in,out] neighbors of the points
/// \param[out] tree see findNeighbors; unchanged if no point is set aside
Stacks
chooseNet (Points& points, CsrLists& neighbors, const NeighborSettings& settings,
           const RunContext& run, std::optional<KdTree>* tree);

} // namespace pcl::floater
