// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts a surface into charts: compact, nearly flat discs that end at creases; before, it smooths strong noise.
#pragma once

#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Limits of a chart. They do not change the mesh.
struct ChartLimits
{
  /// Largest mean of 1 - cos of the angles to the mean normal of a chart, plus the costs of creases
  /// and of area that is turned away: half a sphere has 0.5, half a tube 0.36. More can hardly be
  /// flattened.
  double deviation = 0.5;

  /// `deviation` for charts of more than `large` triangles. A cap of 60 degrees of a sphere has
  /// 0.25: it can be projected, which is a good start for its layout. Without it, the layout takes
  /// ten times as long.
  double deviation_of_large = 0.25;
  std::size_t large = 1000; ///< triangles

  /// Cosine below which area counts as turned away from the mean normal of its chart: 80 degrees.
  double away_cosine = 0.17;

  /// Cost of the share of area that is turned away, in deviations: a twentieth takes up half of the
  /// limit. A chart that hides a piece of itself cannot be projected.
  double away_weight = 5.0;

  /// Largest angle between a triangle and the mean normal of its facet, as 1 - cos: 25 degrees,
  /// below the edges of machined parts (30 and more) and above the curvature of good samplings.
  double facet_deviation = 0.1;

  /// Cost of a crease of a right angle, in deviations: a quarter turn of one side adds as much as
  /// the deviation of two flat sides (1 - cos 45 degrees, 0.29), so joining two faces of a box
  /// exceeds 0.5.
  double crease_weight = 0.25;

  /// Cost of a seam as long as the border of a disc of the same area, in deviations. Decisive on
  /// flat surfaces only.
  double seam_weight = 0.05;

  /// A chart with so few triangles, and with less than this share of the joint area, is joined to a
  /// neighbouring chart at the end, however it bends: alone it would waste space in the texture.
  std::size_t most_in_crumb = 16;
  double crumb_share = 0.1;

  /// Number of facets, the units from which charts are joined: the search is sequential, and 20,000
  /// facets take a tenth of a second.
  std::size_t facets = 20'000;

  /// Maximum triangles of a facet; more would be wider than the details of the surface.
  std::size_t most_in_facet = 16;

  /// Maximum triangles of a chart, to limit the time and memory of its linear systems.
  std::size_t most_triangles = 150'000;

  /// Weight of a seam along a sharp crease relative to one across a flat region, when seams are
  /// straightened: seams stay on creases.
  double least_seam_weight = 0.1;

  int straightening_rounds = 8; ///< maximum; it ends when nothing changes
};

/// Area vectors of all triangles: twice the area times the unit normal. O(n).
Positions
areaVectors (const TriangleMesh& mesh, const Positions& positions, const RunContext& run);

/// Moves rough vertices, and those around them, to the mean of their neighbours (at the boundary,
/// of those along it) until they are smooth. Charts are found and laid out on this surface: on the
/// noisy one, normals are random, and every bump becomes a chart. O(n) for each round; one if there
/// is no noise.
/// \return positions per point; other vertices are unchanged
Positions
smoothNoise (const TriangleMesh& mesh, const Positions& original, const RunContext& run);

/// Joins neighbouring triangles to facets: discs, at most as large as ChartLimits::most_in_facet
/// and flatter than ChartLimits::facet_deviation. Few triangles stay alone. O(n), one thread: 0.2
/// microseconds per triangle.
MeshComponents
growFacets (const TriangleMesh& mesh, const Positions& positions,
            const std::vector<Vector3d>& area_vectors, const ChartLimits& limits,
            const RunContext& run);

/// Joins the facets of a mesh to charts, cheapest pair first (Garland, Willmott, Heckbert 2001:
/// hierarchical clustering of faces). Costs: the deviation of the normals in the new chart, the
/// crease between the two, and the length of the seams around it. Two are joined only if the union
/// is a disc, tested by Euler's formula: so every chart is a disc with a simple boundary. Then
/// straightens the seams: triangles with two edges on a seam move to the chart beyond it where this
/// shortens the seam, with less weight along creases. O(n log n), mostly in one thread: a second for
/// a million triangles.
/// \param halves the mesh is cut in two, if it can be, whatever the deviation of the charts
MeshComponents
findCharts (const TriangleMesh& mesh, const Positions& positions, bool halves,
            const ChartLimits& limits, const RunContext& run);

} // namespace pcl::floater
