// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Places from which the areas of patches look most alike: roughly those that a cloud may be seen from.
#pragma once

#include "core/run_context.h"
#include "view/area_samples.h"
#include "view/pattern_search.h"

#include <cstddef>
#include <vector>

namespace pcl::floater {
/// Size of the search, and its thresholds.
struct AreaSearchLimits
{
  double explained =
      0.8; ///< largest share of the spread of the areas (logarithm of the ratio of the
           ///< quartiles) left at the best viewpoint; with more, areas do not come
           ///< from a view. In scans with noise of 3 spacings, 0.7 is left
  double as_good = 0.75; ///< share of what the best viewpoint explains; those that explain less are
                         ///< left out: on a plane, many explain as much
  std::size_t cells =
      12; ///< along each axis of a grid of viewpoints over twice the bounding box, and
          ///< of one over twice the box of half of the samples: points are dense
          ///< around a sensor low above wide ground
  std::size_t directions = 100;  ///< of farther viewpoints: 20 degrees apart
  std::size_t starts = 24;       ///< best viewpoints, from which descents start
  std::size_t evaluations = 200; ///< in each descent
};

/// Spread of the areas without any viewpoint.
double
spreadOfAreas (const std::vector<AreaSample>& samples);

/// \return places to about a hundredth of the bounding box, the best ones first; none if areas do not
/// come from a view
/// \param may_be_far directions of parallel rays are tried, too
std::vector<RatedViewpoint>
searchByAreas (const std::vector<AreaSample>& samples, const Eigen::AlignedBox3d& box,
               bool may_be_far, const AreaSearchLimits& limits, const RunContext& run);

} // namespace pcl::floater
