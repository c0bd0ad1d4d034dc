// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Adds points to a mesh by vertex splits.
#pragma once

#include "core/run_context.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Costs of a mesh whose points lie on one another, each a length. Its bending is the sum over its
/// edges of length times angle between the triangles: bounded for needles. The other costs were
/// chosen by hand; without one of them, crossing triangles or folds became many times as many.
struct SplitLimits
{
  std::size_t near =
      4; ///< nearest vertices of a point, whose fans may be split. With 3 and 6, folds
         ///< were a tenth more and fewer, crossing pairs the other way round
  std::size_t most_cuts = 4096; ///< tried of a fan, about
  double fold = 30.0;           ///< of a fold, or a triangle without area, in longest edges of
                                ///< the fan
  double flat = 0.03;           ///< sine of an angle; below, a triangle has no area
  double boundary = 6.28;       ///< of an edge of the boundary, per length: else fins grow there.
                                ///< One between two points of a stack counts as the longest edge
                                ///< of the fan: else the boundary passes through both
  double far = 10.0;            ///< per length from the point to the vertex that is split
};

/// Adds points to a mesh: each, in the given order, by the cheapest split of one of the nearest
/// vertices. A split cuts the fan of a vertex along two edges, or one at the boundary, gives the new
/// point a part of it, and closes the cuts by triangles with both points (the inverse of an edge
/// collapse: Hoppe 1996). So neither manifold nor topology nor orientation can change. One
/// thread, O(log n) for each point.
/// \param added points without triangles
/// \return number of points added
std::size_t
splitVertices (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const std::vector<Index>& added, const SplitLimits& limits, const RunContext& run);

} // namespace pcl::floater
