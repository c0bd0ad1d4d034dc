// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Test whether a cloud was seen from a viewpoint: its rays are evenly spaced, and no point hides
// another.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "local/local_geometry.h"
#include "points/neighbors.h"
#include "points/points.h"
#include "view/rays.h"

#include <vector>

namespace pcl::floater {
struct RowEvidence
{
  double share = 0.0; ///< share of points between their two nearest neighbours, on opposite sides
  Eigen::Vector3d across = Eigen::Vector3d::Zero (); ///< unit vector across the planes of the rows
  bool are_straight = true; ///< all rows have one direction, so their planes are undetermined
};

/// \param neighbors nearest first
/// \param count number of tested points, spread evenly over their order. O(count).
RowEvidence
findRows (const Points& points, const NeighborTable& neighbors, std::size_t count,
          const RunContext& run);

/// Patches of near points around points that are spread evenly over their order. Parallel rays to a
/// patch are near each other for any direction.
/// \param neighbors of each point
/// \param count     of patches
/// \param size      points of a patch; fewer if there are no more around
/// \return the points of each patch, sorted by distance to the first one
std::vector<RayPatch>
findPointPatches (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  std::size_t count, std::size_t size, const RunContext& run);

struct EvidenceLimits
{
  std::size_t patches = 128;     ///< patches of rays, spread over the cloud
  std::size_t patch_points = 60; ///< rays in each; those in the middle half are tested

  double near_ratio = 0.45; ///< a ray is near another if their distance is below this share of the
                            ///< next one. On a scanner's raster both are the same, or one is half
                            ///< the other at the end of a row
  double near_share = 0.01; ///< largest allowed share of near rays. On a raster there are none;
                            ///< where points behind others are visible, rays are random, and it is
                            ///< the square of near_ratio, 20 %
  double regularity = 0.25; ///< largest ratio of the spread of the ray distances to the spread of
                            ///< the point distances. On an evenly sampled sphere seen from its
                            ///< centre, both are the same
};

/// Evenness of the rays to a cloud.
struct RayEvidence
{
  double near_share = 1.0;   ///< share of rays that are near another one
  double ray_spread = 0.0;   ///< logarithm of the ratio of large to small distances between
                             ///< neighbouring rays (their 90 and 10 % quantiles); mean of patches
  double row_spread = 0.0;   ///< spread of the distances to the nearest ray across the direction of
                             ///< the nearest: to the next row of a scanner
  double point_spread = 0.0; ///< spread of the distances in space between their points
};

/// Patches around points that are spread evenly over the order of the points. O(patches * n).
std::vector<RayPatch>
findRayPatches (const std::vector<Eigen::Vector3d>& positions, const Viewpoint& viewpoint,
                const EvidenceLimits& limits, const RunContext& run);

/// Evidence from the rays of the patches, which may come from another viewpoint nearby. O(patches *
/// points of a patch squared).
/// \param with_rows also RayEvidence::row_spread, at twice the time
RayEvidence
findRayEvidence (const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<RayPatch>& patches, const Viewpoint& viewpoint,
                 const EvidenceLimits& limits, const RunContext& run, bool with_rows = false);

/// Whether the evidence shows that the cloud was seen from the viewpoint.
bool
isSeenFromThere (const RayEvidence& evidence, const EvidenceLimits& limits);

/// A point and the area around it.
struct AreaSample
{
  Eigen::Vector3d position, normal;
  double area; ///< of its star, times six
};

/// At most `2 * count` points, spread evenly over the order of the points; ascending.
std::vector<Index>
areaSampleCentres (std::size_t points, std::size_t count);

/// The samples of some points, except those with an open star. O(count).
/// \param stars the i-th belongs to centres[i]
std::vector<AreaSample>
takeAreaSamples (const std::vector<Index>& centres, const std::vector<Eigen::Vector3d>& positions,
                 const Stars& stars, const RunContext& run);

/// Area samples at at most `2 * count` points, spread evenly over their order, except those with an
/// open star. O(count).
/// \param settings of the stars
std::vector<AreaSample>
takeAreaSamples (const Points& points, const LocalPlanes& planes, const StarSettings& settings,
                 std::size_t count, const RunContext& run);

/// Logarithm of the ratio of the upper to the lower quartile.
/// \param[in,out] values at least one, all positive; their order changes
double
quartileSpread (std::vector<double>& values);

/// Spread of the solid angles of the samples from a viewpoint: area, times the cosine between
/// normal and ray, over the squared distance.
/// \param angles scratch, one for each sample
double
areaSpread (const std::vector<AreaSample>& samples, const Viewpoint& viewpoint,
            std::vector<double>& angles);

} // namespace pcl::floater
