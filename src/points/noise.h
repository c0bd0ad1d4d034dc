// SPDX-License-Identifier: GPL-3.0-or-later
// How noisy the points are, and where they would lie without most of the noise.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// The noise of a cloud, in local spacings (mean distance of a point to its 6 nearest): the median
/// over points of the root mean square distance of its (up to 20) nearest neighbours to the surface
/// that fits them best. That surface is the plane of the 8 nearest or the quadric of them all,
/// whichever is nearer: the plane sees little of edges and other sheets, the quadric takes
/// curvature out. Measured at 2048 to 4095 points of a larger cloud, evenly spread over it: 5
/// milliseconds at most. \param near nearest neighbours, nearest first \return 0 for fewer than 5
/// points
double
measureNoise (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const RunContext& run);

/// Noise from which on points are better connected as they lie in their local planes. Clouds that
/// are clean, however thin, sharp or coarse, measure up to 0.08; normal noise with a standard
/// deviation of 0.2 spacings in each coordinate 0.15 to 0.19, with 0.3 spacings 0.21 to 0.27, with
/// 0.5 spacings 0.31 to 0.36.
constexpr double STRONG_NOISE = 0.15;

/// Whether a cloud of so many points is that noisy. Never with fewer than 400: too coarse to tell.
bool
isStrongNoise (double noise, std::size_t points);

/// Every point projected once on the plane of its (up to 20) nearest neighbours and itself. The
/// plane is fitted robustly: those far off it for their median, as on another sheet or beyond an
/// edge, lose their weight. Points with fewer than 3 neighbours stay where they are. 2 microseconds
/// per point. \param near nearest neighbours, nearest first; those of the result differ a little
std::vector<Eigen::Vector3d>
projectOntoPlanes (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                   const RunContext& run);

} // namespace floater
} // namespace pcl
