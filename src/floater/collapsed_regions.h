// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Regions in which a parameterization has shrunk so far that double precision is about to run out.
#pragma once

#include "core/run_context.h"
#include "floater/disc_limits.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// A disc of triangles that is too small in the plane, and all points that lie in it.
struct CollapsedRegion
{
  std::vector<Index> triangles; ///< ascending
  std::vector<Index> loop;      ///< boundary points in order, the region on the left; these are
                                ///< still placed well
  std::vector<Index> interior;  ///< ascending; points of the region that are not on its loop, and
                                ///< points without a triangle that coincide with one of its points
};

/// Finds the regions whose scale, relative to that of the loop, is below
/// DiscLimits::collapsed_scale.
///
/// Each region is one disc with a simple boundary loop and shares no point with the boundary of the
/// mesh. No edge outside of a region joins two points of its loop, so that the region can be
/// triangulated anew without regard to the rest. Regions share no triangle, edge or interior point.
/// One pass over the triangles where there is no such region, otherwise O(n log n).
/// \param mesh      triangulation of the parameters, a disc (see triangulatePlane ())
/// \param uv        per point
/// \param positions per point
/// \param loop      boundary points of the mesh in order
std::vector<CollapsedRegion>
findCollapsedRegions (const TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                      const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
                      const RunContext& run, const DiscLimits& limits = {});

} // namespace pcl::floater
