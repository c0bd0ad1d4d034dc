// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Packs charts into the unit square.
#pragma once

#include "core/run_context.h"
#include "texture/chart_layout.h"

namespace pcl::floater {
/// Settings of the packing.
struct AtlasLimits
{
  /// Packing cells along the side of the square. Charts are 2 cells apart: 4 pixels of a texture of
  /// 2048, enough for two levels of a mipmap.
  std::size_t cells = 1024;

  /// For many charts: cells along the side, for each square root of their number. A chart of one
  /// triangle takes at least 3 x 3.
  double cells_per_chart = 12.0;

  double first_fill = 0.75; ///< share of the square to be covered in the first attempt
  int attempts = 4;         ///< number of tries for the width of the square
};

/// Scales every chart to an area proportional to its area in space times its stretch (if that is at
/// most 1000), which minimizes the total stretch, and to a length of a sixteenth of a cell to 4
/// squares; rotates it to the smallest box; and packs all into the unit square,
/// largest first, each in one of four directions, at the lowest free position. Free are cells that
/// no triangle touches. The coordinates are then in the square. O(triangles + charts cells^2).
/// \param[in,out] charts laid out, none empty
/// \return least distance of two charts, in sides of the square; half of it at the border. Charts of
///     about one cell may be nearer by rounding
double
packCharts (std::vector<ChartLayout>& charts, const AtlasLimits& limits, const RunContext& run);

} // namespace pcl::floater
