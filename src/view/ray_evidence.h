// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Test whether a cloud was seen from a viewpoint: its rays are evenly spaced, and no point hides
// another.
#pragma once

#include "core/run_context.h"
#include "points/points.h"
#include "view/rays.h"

namespace pcl::floater {
/// Points of a patch of rays, sorted by the angle to the first ray.
using RayPatch = std::vector<Index>;

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
  double least_spread = 0.02; ///< of the point distances; less is no evidence: the points of a ball
                              ///< are as even as their rays from its middle
  std::size_t fewest_patches = 4; ///< that a cloud must fill to be recognised

  std::size_t density_rank = 8; ///< density is measured by the distance to the neighbour of this
      ///< rank: lost rays, rings that are uneven, and rows of two distances
      ///< hardly change it
  /// `regularity` for these, over the whole cloud. In 80 generated clouds, scans have up to 0.47;
  /// others that hide as little from the origin have 0.59 and more
  double density_regularity = 0.5;
  /// `least_spread` for these. Points on a hexagonal raster have 0.15
  double least_density_spread = 0.2;
  double crossing_share = 0.05; ///< largest share of near rays for this evidence. Several scans of
                                ///< one place have 0.07 and more; a scan from a moving car, 0.03
  double hidden_share = 0.004;  ///< largest share of rays beside which one goes far beyond or ends
                                ///< far before, where the densities just meet density_regularity;
                                ///< more if they are more alike, in proportion. A clean depth frame
  ///< seen from 60 % of its depth beside the camera has 0.009 at 0.34; scans
  ///< from a moving car 0.003 to 0.022 at 0.2; from a standing one, 0.003
  double hidden_if_told = 0.03; ///< `hidden_share` of a scan whose place is told, such as one with
                                ///< much noise after a voxel filter, 0.018. Bodies seen from
                                ///< outside have 0.1 and more
  double hidden_slope = 4.0;    ///< difference of their depths over the distance to the second ray;
                                ///< as StepLimits::slope
  double beside = 0.25; ///< of the median depth: distance of six places around the viewpoint from
                        ///< which the densities must not be more alike ...
  double less_beside = 0.7; ///< ... than this factor, or at all if too much is hidden, ...
  /// ... unless their spread is below this at the viewpoint, and little is hidden. A quarter of the
  /// depth nearer to the right place, generated scans have a factor of 0.4 to 0.77; around the
  /// right place, 0.89 and more; around that of 40 scans from a car, 1.2 and more. Around one of
  /// several lidars whose scans are merged, 0.73 to 1.0
  double even_density = 0.2;
  std::size_t patches_beside = 32; ///< for this comparison
  double all_sides =
      20.0; ///< degrees; if there is a ray in each direction to this angle, the points
            ///< lie on a body around the viewpoint, as no sensor looks to all sides
  double at_sensor = 0.1; ///< of the median depth; nearer points lie on what bears the sensor
};

/// Evenness of the rays to a patch or a cloud.
struct RayEvidence
{
  std::size_t judged = 0;    ///< number of rays
  std::size_t near = 0;      ///< those that are near another one
  double ray_spread = 0.0;   ///< logarithm of the ratio of large to small distances between
                             ///< neighbouring rays (their 90 and 10 % quantiles); mean of patches
  double point_spread = 0.0; ///< spread of the distances in space between their points

  double nearShare () const
  {
    return judged > 0 ? static_cast<double> (near) / static_cast<double> (judged) : 1.0;
  }
};

/// Patches of near rays around points that are spread evenly over their order. O(n).
std::vector<RayPatch>
findRayPatches (const Positions& positions, const Viewpoint& viewpoint,
                const EvidenceLimits& limits, const RunContext& run);

/// Evidence from the rays of the patches, which may come from another viewpoint nearby. O(patches *
/// points of a patch squared).
RayEvidence
findRayEvidence (const Positions& positions, const std::vector<RayPatch>& patches,
                 const Viewpoint& viewpoint, const EvidenceLimits& limits, const RunContext& run);

/// What a search lowers: RayEvidence::ray_spread, to which `with_rows` adds the spread of the distances
/// to the nearest ray across the direction of the nearest, to the next row of a scanner. For rays from
/// a place, the means of both leave out the quarter of the patches with the largest. Towards the
/// viewpoint it falls all the way, while the share of near rays first rises where outlines begin to
/// overlap. Same cost.
double
findRaySpread (const Positions& positions, const std::vector<RayPatch>& patches,
               const Viewpoint& viewpoint, bool with_rows, const RunContext& run);

/// Whether the evidence shows that the cloud was seen from the viewpoint.
bool
isSeenFromThere (const RayEvidence& evidence, const EvidenceLimits& limits);

/// How dense the points are, and their rays: by the distance to the neighbour of density_rank. Without the
/// points at the sensor.
struct DensityEvidence
{
  double near_share = 1.0;   ///< as RayEvidence::nearShare
  double hidden_share = 1.0; ///< of rays beside which one goes far beyond, or ends far before
  double ray_spread = 0.0;   ///< as RayEvidence::ray_spread, over the whole cloud
  double point_spread = 0.0; ///< of the points in space
  double depth = 0.0;        ///< median of the rays

  /// Share of the points' spread that is left in the rays.
  double left (const EvidenceLimits& limits) const
  {
    return ray_spread / std::max (point_spread, limits.least_density_spread);
  }
};

/// O(patches * points of a patch squared).
/// \param viewpoint not far away
DensityEvidence
findDensityEvidence (const Positions& positions, const std::vector<RayPatch>& patches,
                     const Viewpoint& viewpoint, const EvidenceLimits& limits,
                     const RunContext& run);

/// Whether the viewpoint explains the density of the points: that of their rays is the same
/// everywhere, unlike that of the points; and hardly any point hides others, or the density is
/// less even from all places beside. Also for rays that are locally uneven, such as rings with lost
/// points. O(1) for most places that do not; else O(n log n).
/// \param found at the viewpoint, which is not far away
bool
explainsDensity (const Positions& positions, const DensityEvidence& found,
                 const Viewpoint& viewpoint, const EvidenceLimits& limits, const RunContext& run);

/// Whether there are rays in all directions.
bool
looksToAllSides (const Positions& positions, const Viewpoint& viewpoint,
                 const EvidenceLimits& limits);

} // namespace pcl::floater
