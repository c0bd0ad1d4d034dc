// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Examines a finished mesh, whatever method made it.
#pragma once

#include "mesh/boundary_loops.h"
#include "mesh/self_intersections.h"
#include "points/points.h"

#include <pcl/surface/floater/report.h>

#include <utility>
#include <vector>

namespace pcl::floater {
/// What the examination counts as odd. None of it changes a mesh.
struct CheckLimits
{
  double long_edge = 6.0;    ///< mean local spacings of its two ends; longer edges inside the
                             ///< surface are counted. Chosen by hand
  double precision = 1e-7;   ///< of coordinates, in bounding box diagonals: single precision
  double flat_height = 1e-3; ///< of a triangle, divided by its longest edge. Chosen by hand.
                             ///< A triangle is degenerate if its height is below both limits
};

/// What triangles form, with the places of what is odd about them. A place is the smallest point
/// where it was found, NONE if there is none.
struct MeshExamination
{
  MeshCheck check;                 ///< lengths in units of the cloud, indices of the cloud
  std::vector<BoundaryLoop> loops; ///< parallel to check.loops: longest first
  std::vector<std::size_t> component_points; ///< vertices of each component
  std::vector<Index> unused;                 ///< points without a triangle, ascending
  Index broken_at = NONE;             ///< not manifold, or two triangles with opposite orientations
  Index fold_at = NONE;               ///< start of a folded edge
  Index degenerate_at = NONE;         ///< corner of a degenerate triangle
  std::vector<CrossingPair> crossing; ///< triangles that cross each other; see checkCrossing
  Index crossing_at = NONE;           ///< corner of such a triangle
  std::size_t long_edges = 0;         ///< longer than CheckLimits::long_edge, not on a boundary
  double longest_inside = 0.0;        ///< the longest of these, in local spacings
  std::pair<Index, Index> longest_inside_at{}; ///< its two ends
  std::size_t smallest_component = 0;          ///< vertices of it
  std::size_t largest_component = 0;           ///< vertices of it
  Index smallest_component_at = NONE;

  bool isManifold () const
  {
    return check.nonmanifold_edges == 0 && check.nonmanifold_vertices == 0 &&
           check.orientation_conflicts == 0;
  }

  /// True for one component with one boundary loop and no handle. Only for a manifold.
  bool isDisc () const
  {
    return check.components == 1 && loops.size () == 1 && check.euler_characteristic == 1;
  }
};

/// Examines triangles by nothing but their corners, the positions and the local spacings. Any input
/// is allowed. A triangle that names a point twice, or one that does not exist, counts as one
/// non-manifold edge and as degenerate, and is otherwise ignored. Two triangles on the same three
/// points, back to back, make their corners non-manifold.
///
/// The genus and the loops mean something only if isManifold (). Components are connected by edges.
/// BoundaryLoop::component and component_points count components that share a vertex as one. A fold
/// is an edge whose two triangles are more than 120 degrees apart (isFold). Loops are measured by
/// measureLoop ().
///
/// O(n), on all threads, whose number does not matter to what is found. 0.2 microseconds of one
/// thread per point. While it runs, 12 bytes per point if points and triangles are in an order in
/// which those next to each other are near; 28 if the triangles are in random order, and up to 76
/// one `\param` in each line
MeshExamination
checkMesh (const std::vector<Triangle>& triangles, const Points& points,
           const std::vector<float>& spacing, const RunContext& run,
           const CheckLimits& limits = {});

/// Adds the pairs of triangles that cross each other, and their places, to what checkMesh () found;
/// nothing if the mesh is no manifold. See findSelfIntersections. The decisions are exact for the
/// positions of the points, which are those of the cloud up to rounding in double precision.
void
checkCrossing (const std::vector<Triangle>& triangles, const Points& points, const RunContext& run,
               MeshExamination& found);

} // namespace pcl::floater
