// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts a surface into charts: discs that are compact, nearly flat, and end at creases.
#pragma once

#include "mesh/triangle_mesh.h"
#include "texture/chart_limits.h"
#include "texture/facets.h"

#include <vector>

namespace pcl::floater {
/// How far charts are to grow.
struct ChartGrowth
{
  double deviation = 0.5; ///< mean of 1 - cos of the angles to the mean normal, with what creases
                          ///< on the way cost (see ChartLimits)
  std::size_t charts = 1; ///< no fewer than that many are made
};

/// Joins the facets of a mesh to charts, always those two first that cost least (Garland, Willmott,
/// Heckbert 2001: hierarchical clustering of faces): the deviation of the normals in the new chart,
/// the crease between the two, and the length of the seams around it. Two are joined only if the
/// new one is a disc: what they share must be one path, which is counted by Euler's formula. So
/// every chart is a disc whose boundary touches itself nowhere. Then seams are straightened.
///
/// O(n log n) and one thread, but for a few loops: a second for a million triangles.
MeshParts
findCharts (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            const ChartGrowth& growth, const ChartLimits& limits, const RunContext& run);

/// Moves triangles with two edges on a seam to the chart beyond it where that makes the seam
/// shorter, along creases by the weights of ChartLimits. Discs stay discs, and none vanishes.
void
straightenSeams (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<Eigen::Vector3d>& area_vectors, const ChartLimits& limits,
                 const RunContext& run, MeshParts& charts);

} // namespace pcl::floater
