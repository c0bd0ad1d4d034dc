// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points that lie off any surface.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/rows.h"

#include <vector>

namespace pcl::floater {
/// When a point lies off any surface. Distances are in reaches: the distance of a point to its 6th
/// nearest neighbour, about 1.3 spacings. The values were chosen on seeded clouds with outliers
/// strewn into the box around them, and on the clouds of the first benchmark, which lose no point
/// to them; a thin spike of the surface may.
struct OutlierLimits
{
  double far = 5.0;        ///< reaches to the rest from which on a small cluster lies apart
  double off_plane = 1.75; ///< reaches above its neighbours' plane from which on a point lies apart
  double flat = 0.25; ///< of that height: the neighbours' median distance to their plane is smaller
  double stray = 3.0; ///< of that median: neighbours beyond do not belong to the plane
  std::size_t cluster = 7; ///< points of the largest cluster that may be left out
  std::size_t own = 12;    ///< a point counts as one of another's own if among its 12 nearest
  std::size_t owners = 4;  ///< so many points have a point of a surface among their own
};

/// Whether a cloud has enough points to tell outliers.
inline bool
mayHaveOutliers (std::size_t points, const OutlierLimits& limits)
{
  return points >= 3 * limits.cluster;
}

/// Distance of points to their 6th nearest neighbour; 0 if they have none.
/// \param neighbors   of the points in `rows`, nearest first; those of others are not read
/// \param[out] reach  of the points in `rows`; others are left alone
void
findReaches (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
             const Rows& rows, std::vector<float>& reach, const RunContext& run);

/// Whether points lie apart, 1 or 0 for each of the rows: the first part of findOutliers.
/// \param neighbors of the points in `rows`
/// \param reach     of these, and of their 20 nearest neighbours
std::vector<std::uint8_t>
findApart (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
           const std::vector<float>& reach, const Rows& rows, const OutlierLimits& limits,
           const RunContext& run);

/// Those of the points apart that are outliers, ascending: the second part of findOutliers.
/// \param neighbors of all points, at least the 12 nearest of each
/// \param apart     of all points
std::vector<Index>
chooseOutliers (const CsrLists& neighbors, std::vector<std::uint8_t> apart,
                const OutlierLimits& limits);

/// Points to leave out, ascending. A point is one if it lies apart, in one of two ways:
///  - it and at most 6 others are farther from all else than 5 times the reach of the points there;
///  - it lies off the plane of its neighbours by more than 1.75 times their reach, while they lie
///    well on that plane without it;
/// and if the points of the surface do not count it among their own nearest. That keeps what is
/// sparse but connected, as beside a part of the cloud that is many times denser. There are none in
/// clouds of fewer than 21 points. 0.2 microseconds per point, in one thread where there is
/// something to decide.
/// \param neighbors of each point, nearest first
std::vector<Index>
findOutliers (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const RunContext& run, const OutlierLimits& limits = {});

} // namespace pcl::floater
