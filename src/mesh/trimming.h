// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts long edges and small components off a finished mesh.
#pragma once

#include "mesh/triangle_mesh.h"
#include "points/points.h"

namespace pcl::floater {
/// Removes triangles. If a point then has several fans of triangles, only the largest (the first of
/// equal ones) is kept, and the triangles of the others are removed as well, repeatedly. The mesh
/// stays an oriented manifold, and may become empty. O(n).
/// \param is_removed of each triangle: 1 to remove it
void
removeTriangles (TriangleMesh& mesh, Flags is_removed, const RunContext& run);

/// Removes components of fewer points. O(n).
/// \return number of components removed
std::size_t
removeSmallComponents (TriangleMesh& mesh, std::size_t fewest_points, const RunContext& run);

/// Result of trimMesh ().
struct Trimming
{
  std::size_t triangles = 0;
  std::size_t crossing = 0;   ///< of these, triangles that crossed others
  std::size_t components = 0; ///< too small ones, after long edges were cut off
  std::vector<Index> points;  ///< points that lost all their triangles, ascending
};

/// Whether the options request any trimming.
bool
asksForTrimming (const TrimmingOptions& options);

/// Removes triangles with too long an edge. Then removes crossing triangles until none are left:
/// those that cross most others first, the first of equal ones; then components of too few points.
/// What is left: see removeTriangles (). One thread: 0.2 microseconds per point, plus the time of
/// findSelfIntersections for crossing triangles.
/// \param spacing local spacing of each point
Trimming
trimMesh (TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
          const TrimmingOptions& options, const RunContext& run);

} // namespace pcl::floater
