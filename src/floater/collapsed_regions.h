// SPDX-License-Identifier: GPL-3.0-or-later
// Where a parameterization has shrunk so far that double precision is about to run out.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// A disc of triangles that is too small in the plane, with all that has collapsed into it.
struct CollapsedRegion
{
  std::vector<Index> triangles; ///< ascending
  std::vector<Index> loop;      ///< points in order, the region on the left; still well placed
  std::vector<Index> interior;  ///< ascending; points of the region that are not on its rim, and
                                ///< points without a triangle that coincide with one of its points
};

/// Regions in which lengths in the plane are below 1e-6 of those in space, as the loop's compare.
/// There they are still exact to about eight digits of the plane's sixteen.
///
/// Each region is one disc with a simple rim, away from the loop; no edge outside of a region joins
/// two points of its rim, so that the region can be triangulated anew without regard to the rest.
/// Regions do not share triangles, edges or interior points. One pass over the triangles where
/// there is no such region, else O(n log n).
/// \param mesh triangulation of the parameters, a disc (see triangulatePlane)
/// \param uv   per point
/// \param loop points of its boundary in order
std::vector<CollapsedRegion>
findCollapsedRegions (const TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& uv,
                      const std::vector<Eigen::Vector3d>& positions,
                      const std::vector<Index>& loop);

} // namespace floater
} // namespace pcl
