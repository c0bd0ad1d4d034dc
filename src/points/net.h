// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points that lie on one another: a well-spaced subset is connected first.
#pragma once

#include "points/neighbors.h"
#include "points/points.h"

namespace pcl::floater {
/// Thresholds of the net. Stacks are first and last returns of a laser on hard ground, overlapping
/// strips, merged scans: points apart along the normal, by a few percent of the spacing.
struct NetLimits
{
  double near = 0.2;   ///< spacings; nearer points show that there are stacks
  double gap = 0.3;    ///< spacings, between points of the net, where there are. With 0.2, several
                       ///< points of a stack as high as 0.15 were in the net, and made it noisy
  double equal = 1e-3; ///< spacings; nearer points are the same but for rounding. Among 100,000
                       ///< random points there is one such pair by chance in every third cloud
  std::size_t least_points = 100; ///< in smaller clouds, shares are chance
  /// Share of points in a block that others set aside, and the median cosine between normal and
  /// offset: above both, there are stacks. A random sample has the share 0.04, and offsets in all
  /// directions the cosine 0.5. Points on lines, with random steps, are near each other in the plane.
  double share = 0.1, least_cosine = 0.25;
  /// Share above which stacks along the normal are set aside, and the median cosine between normal
  /// and offset that shows them. Random samples with noise reach the share up to noise of 0.1
  /// spacings, and the cosine from 0.3 spacings on.
  double share_along_normal = 0.03, cosine = 0.55;
  double least_aspect = 0.01; ///< middle over largest eigenvalue of the points around; below, they
                              ///< are a line, on which points may be as uneven as they like
  /// A point that has its six nearest within this part of the distance to the last one is in a
  /// cluster: its spacing is `cluster_spacing` of that distance, as between 20 points on a plane.
  double cluster = 0.1, cluster_spacing = 0.4;
  std::size_t rounds = 20; ///< at most. Clouds of the air took up to 10
};

/// Points set aside.
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
           const NetLimits& limits, const RunContext& run, std::optional<KdTree>* tree);

} // namespace pcl::floater
