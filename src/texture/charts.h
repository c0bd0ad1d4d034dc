// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts a surface into charts: compact, nearly flat discs that end at creases.
#pragma once

#include "mesh/triangle_mesh.h"
#include "texture/facets.h"

#include <vector>

namespace pcl::floater {
/// Limits of the growth of charts.
struct ChartGrowth
{
  double deviation = 0.5; ///< mean of 1 - cos of the angles to the mean normal, plus the cost of
                          ///< creases (see ChartLimits)
  std::size_t charts = 1; ///< minimum number of charts
};

/// Joins the facets of a mesh to charts, cheapest pair first (Garland, Willmott, Heckbert 2001:
/// hierarchical clustering of faces). Costs: the deviation of the normals in the new chart, the
/// crease between the two, and the length of the seams around it. Two are joined only if the union
/// is a disc, tested by Euler's formula: so every chart is a disc with a simple boundary. Then
/// straightens the seams. O(n log n), mostly in one thread: a second for a million triangles.
MeshParts
findCharts (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            const ChartGrowth& growth, const ChartLimits& limits, const RunContext& run);

/// Moves triangles with two edges on a seam to the chart beyond it where this shortens the seam,
/// with the weights of ChartLimits along creases. Charts stay discs, and none vanishes.
void
straightenSeams (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<Eigen::Vector3d>& area_vectors, const ChartLimits& limits,
                 const RunContext& run, MeshParts& charts);

} // namespace pcl::floater
