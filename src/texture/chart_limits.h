// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Values that decide into which charts a surface is cut.
#pragma once

#include <cstddef>

namespace pcl::floater {
/// What a chart may be. None of it changes the mesh.
struct ChartLimits
{
  /// Largest mean of 1 - cos of the angles to the mean normal of a chart, with creases and what is
  /// turned away: half a sphere has 0.5, half a tube 0.36. More can hardly be flat, and is not
  /// tried.
  double deviation = 0.5;

  /// The same of charts of more triangles than that. A cap of 60 degrees of a sphere has 0.25: it
  /// can be projected, which is a good beginning for its layout. Without one, the layout takes ten
  /// times as long.
  double deviation_of_large = 0.25;
  std::size_t large = 1000; ///< triangles

  /// Cosine below which area counts as turned away from the mean normal of its chart: 80 degrees.
  double away_cosine = 0.17;

  /// What a share of area that is turned away costs, in deviations, so that a twentieth of it
  /// takes up half of what is allowed: a chart that hides a part of itself cannot be projected.
  double away_weight = 5.0;

  /// Largest angle between a triangle and the mean normal of its facet, as 1 - cos: 25 degrees,
  /// below the edges of machined parts (30 and more) and above the curvature of good samplings.
  double facet_deviation = 0.1;

  /// What a crease of a right angle costs, in deviations: a quarter of a turn of one side against
  /// the other adds as much as the deviation that two flat sides have together (1 - cos 45 degrees,
  /// 0.29), so that 0.5 is exceeded where two faces of a box would be joined.
  double crease_weight = 0.25;

  /// What a seam costs whose length is that around a disc of the same area, in deviations. It
  /// decides where the surface is flat, and hardly where it is not.
  double seam_weight = 0.05;

  /// A chart of so few triangles, and of such a share of the area of both, is joined to the chart
  /// beside it at the end, however it bends: alone it would take more room in the texture than it
  /// fills.
  std::size_t most_in_crumb = 16;
  double crumb_share = 0.1;

  /// Facets that the triangles are joined to before these are joined to charts: the search is
  /// sequential, and 20,000 facets take a tenth of a second.
  std::size_t facets = 20'000;

  /// Triangles of a facet at most; more would be wider than the details of the surface.
  std::size_t most_in_facet = 16;

  /// Triangles of a chart at most, for the time and memory of its linear systems, which grow faster
  /// than it does.
  std::size_t most_triangles = 150'000;

  /// Weight of a seam along a sharp crease relative to one that crosses a flat region, when seams
  /// are straightened: seams stay on creases.
  double least_seam_weight = 0.1;

  int straightening_rounds = 8; ///< it ends sooner where nothing is left to do
};

} // namespace pcl::floater
