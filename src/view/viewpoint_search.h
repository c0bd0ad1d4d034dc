// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Search for an unknown viewpoint of a cloud.
#pragma once

#include "points/neighbors.h"
#include "points/points.h"
#include "view/area_search.h"

namespace pcl::floater {
/// Factors by which the evidence at a viewpoint may miss EvidenceLimits for the search to go on
/// from there.
struct EvidenceExcess
{
  double regularity, near_share;
};

/// Size of the search, and its thresholds.
struct SearchLimits
{
  double even = 0.35; ///< spread of the areas of patches (logarithm of the ratio of the quartiles);
                      ///< below, the cloud is sampled evenly. Random points have 0.2
  double rows = 0.6; ///< share of points between their two nearest neighbours; above, the cloud was
                     ///< scanned along lines. Random points have 0.25, a square raster 0.33
  double rings =
      0.4; ///< the same of a spinning lidar, for a search by the density of its rays: graded
           ///< sheets are as even from some place. 15 scans of cars have 0.47 and
           ///< more, such sheets of random points up to 0.25
  std::size_t row_directions = 180; ///< tested for such a cloud: one degree apart
  std::size_t by_rows = 4;          ///< best directions, which are refined
  AreaSearchLimits areas;
  double density_regularity = 1.0 / 3.0; ///< of EvidenceLimits, for a place that is not told but
                                         ///< searched. Right ones have up to 0.31, wrong ones 0.38
                                         ///< and more
  std::size_t samples = 500;       ///< sampled areas; the error of the spread of so many is 6 %
  std::size_t by_rays = 3;         ///< best of these by rays, which are refined until one is right
  std::size_t rounds = 7;          ///< of a refinement, each with new patches. With 9, as many of
                                   ///< 278 generated scans were recognised, and none was better
  std::size_t coarse_patches = 32; ///< of EvidenceLimits::patches, in the first three rounds
  std::size_t ray_evaluations = 400; ///< in each round

  /// After each of the first three rounds, and after later ones, which hardly change the evidence.
  /// Near the right viewpoint, outlines may hide each other, so that all rays are near others; not
  /// for parallel rays. In simulated scans, right viewpoints had up to 1.5 and 2.3 in the middle,
  /// and below 1 at the end; wrong ones up to 1.5 and 12. `early_from_far` also holds for all
  /// viewpoints just before the later rounds: there, right ones of 60 simulated scans had up to 0.3
  /// and 0.2, that of a real one 0.9 and 3.2, and wrong ones 0.9 and 3.5 or more.
  EvidenceExcess early{2.0, 100.0}, early_from_far{2.0, 5.0}, late{1.4, 2.0};
};

/// Whether points lie in rows, as those of a line scanner.
struct RowEvidence
{
  double share = 0.0; ///< share of points between their two nearest neighbours, on opposite sides
  Vector3d across = Vector3d::Zero (); ///< unit vector across the planes of the rows
  bool are_straight = true; ///< nearly all have one direction, so their planes are undetermined
};

/// \param row_of neighbours of a point, nearest first
/// \param count number of tested points, spread evenly over their order. O(count).
RowEvidence
findRows (const Points& points, const RowOf& row_of, std::size_t count);

/// Why a viewpoint is searched.
enum class SearchReason
{
  UNEVEN, ///< areas of patches differ, or points lie in rows; nothing is searched if neither is so
  OPEN    ///< the front of what is open, or errors along the rays look like noise or scatter. Far
          ///< places are not searched: rasters of heights are even from there
};

/// Finds the viewpoint of a cloud in two steps.
///
/// Areas: a sensor spaces its rays evenly, so the area around a point grows with the square of the
/// distance, and with the slope to the ray. Area of a patch, times the cosine, over the squared
/// distance, is the solid angle of a ray. The viewpoint where these are most alike is searched on a
/// grid, also far away, and refined.
///
/// Rays: near the best of these, pattern search finds the viewpoints from which the rays are most
/// evenly spaced and no point hides another (see RayEvidence), or the viewpoint explains the density
/// of the points (see explainsDensity). Clouds that fill few patches (EvidenceLimits) have no
/// evidence.
/// \param row_of    neighbours of a point, nearest first
/// \param samples   SearchLimits::samples of the points, see takePatchSamples
/// \return a viewpoint with enough evidence, if there is one. O(n), about 3 microseconds per point.
std::optional<Viewpoint>
findViewpoint (const Points& points, const RowOf& row_of, const std::vector<AreaSample>& samples,
               SearchReason reason, const SearchLimits& limits, const EvidenceLimits& evidence,
               const RunContext& run);

} // namespace pcl::floater
