// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the place from which a cloud was seen, where nobody tells.
#pragma once

#include "points/neighbor_table.h"
#include "points/points.h"
#include "view/area_evidence.h"
#include "view/ray_evidence.h"

#include <optional>
#include <vector>

namespace pcl::floater {
/// How much worse than EvidenceLimits the evidence at a place may be, as factors, for the search to
/// go on from there.
struct EvidenceExcess
{
  double regularity, near_share;
};

/// What is searched, and how long.
struct SearchLimits
{
  double even = 1.0; ///< spread of the areas that points stand for (logarithm of the ratio of the
                     ///< quartiles); below, and without noise, the cloud is sampled evenly, and
                     ///< needs no view. Points at random have 0.5
  double rows = 0.6; ///< share of points between their two nearest neighbours; above, the cloud was
      ///< scanned along lines. Of points at random it is 0.25, on a square raster 0.33
  std::size_t row_directions = 180; ///< in which such a cloud is looked at: one degree apart
  std::size_t by_rows = 4;          ///< best of the directions between, which are refined
  double explained = 0.75; ///< of that spread; with more left at the best place, areas do not come
                           ///< from a view. In scans with noise of 3 spacings, 0.7 is left

  std::size_t samples = 500;    ///< points whose areas are compared; the spread of so many has an
                                ///< error of 6 %
  std::size_t cells = 24;       ///< along each axis of a grid of places over twice the bounding box
  std::size_t directions = 100; ///< in which places farther away are tried: 20 degrees apart
  std::size_t starts = 24;      ///< best places by areas, from which descents start
  std::size_t area_evaluations = 200; ///< in each descent by areas
  std::size_t by_areas = 2;          ///< best of these, which are refined, until one is a viewpoint
  std::size_t compared = 6;          ///< next ones, of which the best by rays is refined
  std::size_t rounds = 2;            ///< of a refinement, each with patches found anew
  std::size_t fits = 6;              ///< after it, each with patches found anew
  std::size_t coarse_patches = 32;   ///< of EvidenceLimits::patches, until the first fit
  std::size_t ray_evaluations = 200; ///< in each round

  /// After each round. At a place that is only near the right one, outlines may hide each other, so
  /// that all rays may be near others; not so along parallel rays.
  EvidenceExcess after_round{2.0, 100.0}, after_round_from_far{2.0, 5.0};
  /// After the first fit, and after the next ones, which hardly change the evidence any more. In
  /// six simulated scans, right places had up to 1.5 and 2.3 after the first fit, and below 1 after
  /// the second; wrong ones up to 1.5 and 12.
  EvidenceExcess after_first_fit{2.0, 5.0}, after_fit{1.4, 2.0};
};

/// Finds the viewpoint of a cloud in two steps.
///
/// Areas: a sensor spaces its rays evenly, so that a point stands for an area of the surface that
/// grows with the square of the distance, and with the slope to the ray. Area of the star, times
/// the cosine, over the squared distance, is the solid angle of a ray. The place where these are
/// most alike is searched on a grid, far away too, and refined.
///
/// Rays: near the best of these places, those from which the rays are spaced most evenly and hide
/// no point are found by pattern search (see RayEvidence).
///
/// Clouds that fill fewer patches (EvidenceLimits) have no evidence.
///
/// \param neighbors nearest first
/// \param samples   SearchLimits::samples of the points, see takeAreaSamples
/// \return a viewpoint with enough evidence, if there is one. O(n), about 3 microseconds per point.
std::optional<Viewpoint>
findViewpoint (const Points& points, const NeighborTable& neighbors,
               const std::vector<AreaSample>& samples, const SearchLimits& limits,
               const EvidenceLimits& evidence, const RunContext& run);

/// The same of a cloud that is sampled evenly, which findViewpoint leaves out. It needs a view only
/// if it is noisy.
std::optional<Viewpoint>
findViewpointOfEven (const Points& points, const NeighborTable& neighbors,
                     const std::vector<AreaSample>& samples, const SearchLimits& limits,
                     const EvidenceLimits& evidence, const RunContext& run);

} // namespace pcl::floater
