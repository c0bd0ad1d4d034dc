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
/// When noise is strong.
struct NoiseLimits
{
  /// Local spacings, by measureNoise (): from here on points are better connected as they lie in
  /// their local planes. Clouds that are clean, however thin, sharp or coarse, measured up to 0.08.
  /// Generated surfaces with normal noise of a standard deviation of 0.2 spacings in each
  /// coordinate measured 0.15 to 0.19, with 0.3 spacings 0.21 to 0.27, with 0.5 spacings 0.31 to
  /// 0.36.
  double strong = 0.15;
  std::size_t fewest_points = 400; ///< with fewer, a thin tube is as rough as noise
};

/// The noise of a cloud, in local spacings (see localSpacing): the median over points of the root
/// mean square distance of its (up to 20) nearest neighbours to the surface that fits them best.
/// That surface is the plane of the 8 nearest or the quadric of them all, whichever is nearer: the
/// plane is hardly disturbed by edges and other sheets, the quadric takes curvature out. Measured
/// at 2048 to 4095 points of a larger cloud, evenly spread over it, in 5 milliseconds at most.
/// \param neighbors of each point, nearest first
/// \return 0 for fewer than 5 points
double
measureNoise (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const RunContext& run);

/// Whether a cloud of so many points is so noisy that it has to be projected.
bool
isStrongNoise (double noise, std::size_t points, const NoiseLimits& limits = {});

/// Every point projected once on the plane of its (up to 20) nearest neighbours and itself. The
/// plane is fitted robustly, by reweighting with Tukey's weights: points that are far off it for
/// their median, as on another sheet or beyond an edge, lose their weight. Points with fewer than 3
/// neighbours stay where they are. 2 microseconds per point. The nearest neighbours of the result
/// differ a little from those of the points.
/// \param neighbors of each point, nearest first
std::vector<Eigen::Vector3d>
projectOntoPlanes (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                   const RunContext& run);

} // namespace floater
} // namespace pcl
