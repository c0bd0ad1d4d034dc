// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Packs charts into the unit square.
#pragma once

#include "core/run_context.h"
#include "texture/chart_layout.h"

#include <vector>

namespace pcl::floater {
/// How charts are packed.
struct AtlasLimits
{
  /// Cells along the side of the square, in which charts are packed. Charts are 2 cells apart: 4
  /// pixels of a texture of 2048, enough for two levels of a mipmap.
  std::size_t cells = 1024;

  /// If there are many charts, there are so many cells for each along the side, times the root of
  /// their number: a chart of one triangle takes at least 3 x 3.
  double cells_per_chart = 12.0;

  double first_fill = 0.75; ///< share of the square that the first attempt counts with
  int attempts = 4;         ///< at a better width of the square
};

/// Where charts lie in the unit square.
struct Atlas
{
  double gutter = 0.0; ///< least distance of two charts, in sides of the square; half of it is kept
                       ///< from the border. Charts in one cell or so may be nearer by rounding
};

/// Scales every chart to an area in proportion to its area in space times its stretch, at which the
/// stretch of the whole is least; turns it so that the box around it is smallest; and packs all
/// into the unit square, each in one of four directions, the largest first, at the lowest place
/// where it is free of others. Whether it is free is decided by cells that the triangles touch. The
/// coordinates of all charts are in the square afterwards. O(triangles + charts cells^2).
/// \param[in,out] charts laid out, none empty
Atlas
packCharts (std::vector<ChartLayout>& charts, const AtlasLimits& limits, const RunContext& run);

} // namespace pcl::floater
