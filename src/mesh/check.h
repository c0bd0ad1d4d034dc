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

/// Number of some flaws, and the smallest point of one, NONE if there is none.
struct FlawCount
{
  std::size_t count = 0;
  Index at = NONE;

  void add (const FlawCount& more)
  {
    count += more.count;
    at = std::min (at, more.at);
  }
};

/// Length of an edge in local spacings, and its ends, the smaller one first.
struct LongEdge
{
  double sqr_length = 0.0;
  std::pair<Index, Index> at{};

  void take (const LongEdge& other)
  {
    if (other.sqr_length > sqr_length)
      *this = other;
  }
};

/// What is found at triangles. Edges belong to the smaller triangle.
struct Figures
{
  std::size_t edges = 0, bent = 0; ///< bent: by more than 60 degrees
  FlawCount broken;                ///< non-manifold, or two triangles with opposite orientations
  FlawCount folds, degenerate;
  FlawCount long_edges; ///< longer than CheckLimits::long_edge, not on a boundary
  LongEdge longest, longest_inside;

  void add (const Figures& more)
  {
    edges += more.edges;
    bent += more.bent;
    broken.add (more.broken);
    folds.add (more.folds);
    degenerate.add (more.degenerate);
    long_edges.add (more.long_edges);
    longest.take (more.longest);
    longest_inside.take (more.longest_inside);
  }
};

/// Figures of a mesh, and positions of its flaws.
struct MeshExamination
{
  MeshCheck check;                 ///< lengths in units of the cloud, indices of the cloud
  std::vector<BoundaryLoop> loops; ///< parallel to check.loops: longest first
  std::vector<std::size_t> component_points; ///< vertices of each component
  std::vector<Index> unused;                 ///< points without a triangle, ascending
  Figures figures;
  CrossingPairs crossing;             ///< triangles that cross; see checkCrossing
  Index crossing_at = NONE;           ///< corner of such a triangle
  std::size_t smallest_component = 0; ///< number of vertices
  std::size_t largest_component = 0;  ///< number of vertices
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
