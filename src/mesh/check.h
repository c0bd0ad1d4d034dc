// SPDX-License-Identifier: GPL-3.0-or-later
// The last look at a mesh, whatever made it.
#pragma once

#include "mesh/boundary_loops.h"
#include "points/points.h"

#include <pcl/surface/floater/report.h>

#include <utility>
#include <vector>

namespace pcl
{
namespace floater
{
/// Edges inside a surface that are longer are told, in local spacings: the mean of both ends.
constexpr double LONG_EDGE = 6.0;

/// What triangles are, with the places of what is odd about them. A place is a point, NONE if there
/// is none: the first in the order of the points.
struct MeshExamination
{
  MeshCheck check;                 ///< lengths in units of the cloud, indices of the cloud
  std::vector<BoundaryLoop> loops; ///< parallel to check.loops; longest first
  std::vector<std::size_t> component_points; ///< vertices of each component
  std::vector<Index> unused;                 ///< points without a triangle, ascending
  Index broken_at = NONE;                    ///< not manifold, or wound against each other
  Index fold_at = NONE;
  Index degenerate_at = NONE;
  std::size_t long_edges = 0;                  ///< longer than LONG_EDGE, not on a boundary
  double longest_inside = 0.0;                 ///< of these, in local spacings ...
  std::pair<Index, Index> longest_inside_at{}; ///< ... and its ends
  std::size_t smallest_component = 0, largest_component = 0; ///< vertices of these
  Index smallest_component_at = NONE;

  bool isManifold () const
  {
    return check.nonmanifold_edges == 0 && check.nonmanifold_vertices == 0 &&
           check.orientation_conflicts == 0;
  }

  /// One component with one boundary loop and no handle. Only for a manifold.
  bool isDisc () const
  {
    return check.components == 1 && loops.size () == 1 && check.euler_characteristic == 1;
  }
};

/// Examines triangles, which are point indices of the working set, from nothing but themselves, the
/// positions and the local spacings. Any input is taken: a triangle that names a point twice, or
/// one that does not exist, counts as a non-manifold edge and as degenerate, and is else left out;
/// two triangles on the same three points, back to back, make their corners non-manifold.
///
/// Genus and loops mean something only if isManifold (). A fold is an edge whose two triangles are
/// more than 120 degrees apart. A triangle is degenerate if its height is below 1e-7 of the
/// diagonal of the cloud, the precision of coordinates, and below a thousandth of its longest edge.
/// Loops are measured by measureLoop ().
///
/// O(n), one thread; 0.1 microseconds per point, 0.4 if the triangles come in no order, and 40
/// bytes per point while it runs.
MeshExamination
checkMesh (const std::vector<Triangle>& triangles, const Points& points,
           const std::vector<float>& spacing, const RunContext& run);

} // namespace floater
} // namespace pcl
