// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Search for an unknown viewpoint of a cloud.
#pragma once

#include "points/neighbors.h"
#include "points/points.h"
#include "view/area_search.h"

namespace pcl::floater {
/// Whether points lie in rows, as those of a line scanner.
struct RowEvidence
{
  double share = 0.0; ///< share of points between their two nearest neighbours, on opposite sides
  Vector3d across = Vector3d::Zero (); ///< unit vector across the planes of the rows
  bool are_straight = true; ///< nearly all have one direction, so their planes are undetermined
};

/// Tests some points, spread evenly over their order. O(1).
/// \param row_of neighbours of a point, nearest first
RowEvidence
findRows (const Points& points, const RowOf& row_of);

/// Why a viewpoint is searched.
enum class SearchReason
{
  UNEVEN, ///< areas of patches differ, or points lie in rows; nothing is searched if neither is so
  OPEN    ///< the front of what is open, or errors along the rays look like noise or scatter. Far
          ///< places are not searched: rasters of heights are even from there
};

/// Finds the viewpoint of a cloud in two steps.
///
/// Areas: a sensor spaces its rays evenly. The area of a patch, times the cosine between its normal
/// and the ray, over the squared distance, is its solid angle. The viewpoint where these are
/// most alike is searched on a grid, also far away, and refined.
///
/// Rays: near the best of these, pattern search finds the viewpoints from which the rays are most
/// evenly spaced and no point hides another (see RayEvidence), or the viewpoint explains the density
/// of the points (see explainsDensity). Clouds that fill few patches have no evidence.
/// \param row_of    neighbours of a point, nearest first
/// \param samples   see takePatchSamples
/// \return a viewpoint with enough evidence, if there is one. O(n), about 3 microseconds per point.
std::optional<Viewpoint>
findViewpoint (const Points& points, const RowOf& row_of, const std::vector<AreaSample>& samples,
               SearchReason reason, const RunContext& run);

} // namespace pcl::floater
