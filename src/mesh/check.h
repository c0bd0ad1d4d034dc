// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Examination of a finished mesh of any method.
#pragma once

#include "mesh/loops.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_mesh.h"
#include "points/points.h"

#include <pcl/surface/floater/report.h>

namespace pcl::floater {
/// Spacing of each point on a mesh: the median length of its edges. For points without edges, the
/// median of all others. O(n).
std::vector<float>
spacingOfMesh (const TriangleMesh& mesh, const Positions& positions, const RunContext& run);

/// A loop in units of the cloud.
LoopSummary
summaryOf (const BoundaryLoop& loop, const Points& points);

/// Thresholds of the examination. They do not change a mesh.
struct CheckLimits
{
  double long_edge = 6.0;    ///< mean local spacings of its two ends; longer edges inside the
                             ///< surface are counted. Chosen by hand
  double precision = 1e-7;   ///< of coordinates, in bounding box diagonals: single precision
  double flat_height = 1e-3; ///< of a triangle, divided by its longest edge. Chosen by hand.
                             ///< A triangle is degenerate if its height is below both limits
};

/// Figures of a mesh, and positions of its flaws: the smallest point of a flaw, NONE if there is
/// none.
struct MeshExamination
{
  MeshCheck check;                 ///< lengths in units of the cloud, indices of the cloud
  std::vector<BoundaryLoop> loops; ///< parallel to check.loops: longest first
  std::vector<std::size_t> component_points; ///< vertices of each component
  std::vector<Index> unused;                 ///< points without a triangle, ascending
  Index broken_at = NONE;      ///< non-manifold, or two triangles with opposite orientations
  double bent_share = 0.0;     ///< of the edges: bent by more than 60 degrees
  Index fold_at = NONE;        ///< start of a folded edge
  Index degenerate_at = NONE;  ///< corner of a degenerate triangle
  CrossingPairs crossing;      ///< triangles that cross; see checkCrossing
  Index crossing_at = NONE;    ///< corner of such a triangle
  std::size_t long_edges = 0;  ///< longer than CheckLimits::long_edge, not on a boundary
  double longest_inside = 0.0; ///< longest edge inside, in local spacings
  std::pair<Index, Index> longest_inside_at{}; ///< its two ends
  std::size_t smallest_component = 0;          ///< number of vertices
  std::size_t largest_component = 0;           ///< number of vertices
  Index smallest_component_at = NONE;

  bool isManifold () const
  {
    return check.nonmanifold_edges == 0 && check.nonmanifold_vertices == 0;
  }

  /// True for one component with one boundary loop and no handle. Requires a manifold.
  bool isDisc () const
  {
    return check.components == 1 && loops.size () == 1 && check.euler_characteristic == 1;
  }
};

/// Examines a mesh: its neighbours are tested against its triangles. If they do not fit, or the
/// triangles around a point are not one fan, there are no components, no loops, and no genus. Folds:
/// see isFold. Loops: see measureLoop (). O(n), on all threads; the result does not depend on their
/// number. Temporarily 12 bytes per point.
/// \param spacing local spacing of each point
MeshExamination
checkMesh (const TriangleMesh& mesh, const Points& points, const std::vector<float>& spacing,
           const RunContext& run, const CheckLimits& limits = {});

/// Adds the self-intersections and their positions to the result of checkMesh (); nothing if the
/// mesh is no manifold. See findSelfIntersections. Exact for the scaled positions, which equal
/// those of the cloud up to rounding in double precision.
/// \param known the crossing pairs of these triangles, if they were found before
void
checkCrossing (const std::vector<Triangle>& triangles, const Points& points, const RunContext& run,
               MeshExamination& found, std::optional<CrossingPairs> known = std::nullopt);

} // namespace pcl::floater
