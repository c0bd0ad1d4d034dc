// SPDX-License-Identifier: GPL-3.0-or-later
// Points that lie off any surface.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Points to leave out, ascending. A point is one if it lies apart, in one of two ways,
///  - it and at most 6 others are farther from all else than 5 times the reach of the points there;
///  - it lies off the plane of its neighbours by more than 1.75 times their reach, while they lie
///    well on that plane without it;
/// and the points of the surface do not count it among their own nearest: that keeps what is
/// sparse but hangs together, as beside a part of the cloud that is many times denser. Reach is a
/// point's distance to its 6th nearest, about 1.3 spacings. None in clouds of fewer than 21 points.
/// 0.2 microseconds per point, serial where there is something to decide.
/// \param near nearest neighbours, nearest first
std::vector<Index>
findOutliers (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const RunContext& run);

} // namespace floater
} // namespace pcl
