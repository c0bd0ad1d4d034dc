// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts long edges and small components off a finished mesh.
#pragma once

#include "mesh/triangle_mesh.h"
#include "points/points.h"

#include <vector>

namespace pcl::floater {
/// What trimMesh () has cut off.
struct Trimming
{
  std::size_t triangles = 0;
  std::size_t crossing = 0;   ///< of these, triangles that crossed others
  std::size_t components = 0; ///< too small ones, after long edges were cut off
  std::vector<Index> points;  ///< vertices that are no more, ascending
};

/// Whether the options ask for anything.
bool
asksForTrimming (const TrimmingOptions& options);

/// Takes out triangles with too long an edge. Of those that cross each other, takes out so many
/// that no two are left: again and again the one that crosses most others, the first of equal ones.
/// Where that leaves a point with several fans of triangles, only the largest fan stays, and of
/// equal ones the first; triangles of the others are taken out as well, until no point has several
/// fans. Then components of too few points are taken out. The mesh stays an oriented manifold, and
/// may become empty. One thread: 0.2 microseconds per point, and for the search for crossing
/// triangles the time of findSelfIntersections.
///
/// \param spacing local spacing of each point
Trimming
trimMesh (TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
          const TrimmingOptions& options, const RunContext& run);

} // namespace pcl::floater
