// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Regions of a parameterization that are too small for double precision.
#pragma once

#include "core/run_context.h"
#include "floater/floater_method.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// A disc of triangles that is too small in the plane, with all its points.
struct CollapsedRegion
{
  std::vector<Index> triangles; ///< ascending
  std::vector<Index> loop;      ///< boundary points in order, the region on the left; their
                                ///< parameters are accurate
  std::vector<Index> interior;  ///< ascending; points of the region that are not on its loop, and
                                ///< points without a triangle that coincide with one of its points
};

/// Finds the regions whose scale, relative to that of the loop, is below
/// DiscLimits::collapsed_scale.
///
/// Each region is one disc with a simple boundary loop and shares no point with the boundary of the
/// mesh. No outer edge joins two points of its loop, so the region can be triangulated
/// independently. Regions share no triangle, edge or interior point. One pass over the triangles
/// without such regions, otherwise O(n log n).
/// \param mesh      triangulation of the parameters, a disc (see triangulatePlane ())
/// \param uv        per point
/// \param positions per point
/// \param loop      boundary points of the mesh in order
std::vector<CollapsedRegion>
findCollapsedRegions (const TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                      const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
                      const RunContext& run, const DiscLimits& limits = {});

} // namespace pcl::floater
