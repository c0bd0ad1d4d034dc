// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a cloud was seen from some place: then its rays are spaced evenly, and none hides a
// point.
#pragma once

#include "view/patch_rays.h"

#include <vector>

namespace pcl::floater {
struct EvidenceLimits
{
  std::size_t patches = 128;     ///< places at which rays are looked at, spread over the cloud
  std::size_t patch_points = 60; ///< rays in each; those in the middle half are judged

  double near_ratio = 0.45; ///< a ray is near another if that is nearer than this share of the
                            ///< distance to the next one. On a scanner's raster both are the same,
                            ///< or one is half the other at the end of a row
  double near_share = 0.01; ///< so many rays may be near another. On a raster it is none; where
                            ///< points behind others are seen, rays lie at random, and it is the
                            ///< square of near_ratio, 20 %
  double regularity = 0.25; ///< the spread of the distances between rays is at most this share of
                            ///< that of the distances between their points. On a sphere that was
                            ///< sampled evenly, and is looked at from its centre, they are the same
};

/// How evenly the rays to a cloud are spaced.
struct RayEvidence
{
  double near_share = 1.0; ///< of rays that are near another one
  double ray_spread = 0.0; ///< logarithm of the ratio of large to small distances between
                           ///< neighbouring rays (their 90 and 10 % quantiles); mean of patches
  double row_spread = 0.0; ///< the same of the distances to the nearest ray across the direction of
                           ///< the nearest: to the next row of a scanner
  double point_spread = 0.0; ///< the same of the distances in space between their points
};

/// Patches around points that are spread evenly over the order of the points. O(patches * n).
std::vector<RayPatch>
findRayPatches (const std::vector<Eigen::Vector3d>& positions, const Viewpoint& viewpoint,
                const EvidenceLimits& limits, const RunContext& run);

/// Looks at the rays of the patches. These may have been found from another viewpoint nearby.
/// O(patches * points of a patch squared).
/// \param with_rows also RayEvidence::row_spread, at twice the time
RayEvidence
findRayEvidence (const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<RayPatch>& patches, const Viewpoint& viewpoint,
                 const EvidenceLimits& limits, const RunContext& run, bool with_rows = false);

/// Whether the evidence tells that the cloud was seen from there.
bool
isSeenFromThere (const RayEvidence& evidence, const EvidenceLimits& limits);

} // namespace pcl::floater
