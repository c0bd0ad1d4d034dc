// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts a surface into charts: compact, nearly flat discs that end at creases; before, it smooths strong noise.
#pragma once

#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Limits of charts, and of the facets that they are joined from.
struct ChartLimits
{
  /// Number of facets: the search for charts is sequential, and 20,000 facets take a tenth of a second.
  std::size_t facets = 20'000;

  /// Maximum triangles of a facet; more would be wider than the details of the surface.
  std::size_t most_in_facet = 16;

  /// Maximum triangles of a chart, to limit the time and memory of its linear systems.
  std::size_t most_triangles = 150'000;

  bool halves = false; ///< cut the mesh in two, if it can be, whatever the deviation of the charts
};

/// Area vectors of all triangles: twice the area times the unit normal. O(n).
Positions
areaVectors (const TriangleMesh& mesh, const Positions& positions, const RunContext& run);

/// Moves rough vertices, and those around them, to the mean of their neighbours (at the boundary,
/// of those along it) until they are smooth. Charts are found and laid out on this surface: on the
/// noisy one, every bump would be a chart. O(n) for each round; one if there is no noise.
/// \return positions per point; other vertices are unchanged
Positions
smoothNoise (const TriangleMesh& mesh, const Positions& original, const RunContext& run);

/// Joins neighbouring triangles to facets: nearly flat discs. Few triangles stay alone. O(n), one
/// thread: 0.2 microseconds per triangle.
MeshComponents
growFacets (const TriangleMesh& mesh, const Positions& positions,
            const std::vector<Vector3d>& area_vectors, const ChartLimits& limits,
            const RunContext& run);

/// Joins the facets of a mesh to charts, cheapest pair first (Garland, Willmott, Heckbert 2001:
/// hierarchical clustering of faces). Costs: the deviation of the normals in the new chart, the
/// crease between the two, and the length of the seams around it. Two are joined only if the union
/// is a disc, tested by Euler's formula. Then straightens the seams: triangles with two edges on one
/// move to the chart beyond it where this shortens it, with less weight along creases. O(n log n),
/// mostly in one thread: a second for a million triangles.
MeshComponents
findCharts (const TriangleMesh& mesh, const Positions& positions, const ChartLimits& limits,
            const RunContext& run);

} // namespace pcl::floater
