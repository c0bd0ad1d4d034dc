// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay triangulation of the parameters (TW 385, section 2; exact predicates, section 6).
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Exact Delaunay triangulation of points in the plane whose hull is the loop. Of points on the
/// very same place only one is a vertex; the others stay without a triangle, and so do points that
/// rounding has put on or beyond the loop. Slivers outside the loop are taken away. O(n log n).
/// \param uv   per point; those that are not finite are left out
/// \param loop points of the hull in order
/// \return triangles anti-clockwise in the plane; no triangle if all points are on one line
TriangleMesh
triangulatePlane (const std::vector<Eigen::Vector2d>& uv, const std::vector<Index>& loop);

} // namespace floater
} // namespace pcl
