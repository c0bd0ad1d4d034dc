// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Tests whether a cloud was seen from a viewpoint: rays are evenly spaced, no point hides another.
#pragma once

#include "core/run_context.h"
#include "points/points.h"
#include "view/rays.h"

namespace pcl::floater {
/// Points of a patch of rays, sorted by the angle to the first ray.
using RayPatch = std::vector<Index>;

/// Rays of a patch; those in the middle half are tested.
constexpr std::size_t PATCH_POINTS = 60;

/// Patches of rays, spread over a cloud.
constexpr std::size_t PATCHES = 128;

/// Largest share of near rays. On a raster there are none; where points behind others are visible, rays are
/// random, and it is the square of their ratio of distances, 20 %.
constexpr double NEAR_SHARE = 0.01;

/// Largest ratio of the spread of the ray distances to the spread of the point distances. On an
/// evenly sampled sphere seen from its centre, both are the same.
constexpr double REGULARITY = 0.25;

/// Largest share of near rays where the density is the evidence. Several scans of one place have
/// 0.07 and more; a scan from a moving car, 0.03.
constexpr double CROSSING_SHARE = 0.05;

/// `DensityEvidence::left`, at most. In 80 generated clouds, scans have up to 0.47; others that hide as
/// little from the origin have 0.59 and more.
constexpr double DENSITY_REGULARITY = 0.5;

/// Nearer points lie on what bears the sensor; share of the median depth.
constexpr double AT_SENSOR = 0.1;

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
findRayPatches (const Positions& positions, const Viewpoint& viewpoint, const RunContext& run,
                std::size_t count = PATCHES);

/// Evidence from the rays of the patches, which may come from another viewpoint nearby. O(patches *
/// points of a patch squared).
RayEvidence
findRayEvidence (const Positions& positions, const std::vector<RayPatch>& patches,
                 const Viewpoint& viewpoint, const RunContext& run);

/// What a search lowers: RayEvidence::ray_spread, to which `with_rows` adds the spread of the distances
/// to the nearest ray across the direction of the nearest, to the next row of a scanner. For rays from
/// a place, the means of both leave out the quarter of the patches with the largest. Towards the
/// viewpoint it falls all the way, while the share of near rays first rises, at outlines. Same cost.
double
findRaySpread (const Positions& positions, const std::vector<RayPatch>& patches,
               const Viewpoint& viewpoint, bool with_rows, const RunContext& run);

/// Whether the evidence shows that the cloud was seen from the viewpoint.
/// \param excess factor by which rays may be less even than that
bool
isSeenFromThere (const RayEvidence& evidence, double excess = 1.0);

/// How dense the points are, and their rays: by the eighth neighbour, without points at the sensor.
struct DensityEvidence
{
  double near_share = 1.0;   ///< as RayEvidence::nearShare
  double hidden_share = 1.0; ///< of rays beside which one goes far beyond, or ends far before
  double ray_spread = 0.0;   ///< as RayEvidence::ray_spread, over the whole cloud
  double point_spread = 0.0; ///< of the points in space
  double depth = 0.0;        ///< median of the rays

  /// Share of the points' spread that is left in the rays.
  double left () const { return ray_spread / std::max (point_spread, LEAST_POINT_SPREAD); }

  /// Less is no evidence. Points on a hexagonal raster have 0.15.
  static constexpr double LEAST_POINT_SPREAD = 0.2;
};

/// O(patches * points of a patch squared).
/// \param viewpoint not far away
DensityEvidence
findDensityEvidence (const Positions& positions, const std::vector<RayPatch>& patches,
                     const Viewpoint& viewpoint, const RunContext& run);

/// Whether the viewpoint explains the density of the points: that of their rays is the same
/// everywhere, unlike that of the points; and hardly any point hides others, or the density is
/// less even from all places beside. Also for rays that are locally uneven, such as rings with lost
/// points. O(1) for most places that do not; else O(n log n).
/// \param found at the viewpoint, which is not far away
/// \param regularity see DENSITY_REGULARITY
bool
explainsDensity (const Positions& positions, const DensityEvidence& found,
                 const Viewpoint& viewpoint, double regularity, const RunContext& run);

/// Whether there are rays in all directions: then it is no sensor, but the middle of a body.
bool
looksToAllSides (const Positions& positions, const Viewpoint& viewpoint);

/// Whether outlines tell that a cloud was seen from a viewpoint, however even its points are. At an
/// outline, near rays end on two surfaces: seen from the sensor, a line parts them; from elsewhere,
/// they are mixed. Each patch with outlines is for the viewpoint or against it; those for it must be
/// more by two standard deviations of chance, so four at least. If they are more, but not by enough,
/// more patches are taken, and all of their rays. O(patches * points of a patch squared).
bool
areOutlinesClear (const Positions& positions, const std::vector<RayPatch>& patches,
                  const Viewpoint& viewpoint, const RunContext& run);

} // namespace pcl::floater
