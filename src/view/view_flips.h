// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which diagonal of a cell of the raster the mesh takes.
#pragma once

#include "mesh/triangle_mesh.h"
#include "view/rays.h"

#include <vector>

namespace pcl::floater {
struct ViewFlipLimits
{
  double angle = 90.0; ///< degrees by which the angles opposite to the new edge may exceed 180 in
                       ///< the view. On a raster it is 0: both diagonals of a cell are Delaunay
  double fold_cost = 5.0; ///< of a fold, in the unit of the cost of an edge: 1 - cosine of the
                          ///< angle between its triangles. The largest change of cost by an edge
                          ///< without a fold is 1.5; so a fold is worth three of these
};

/// Flips edges of the view where that makes the surface smoother: the sum over the edges of
/// 1 - cosine of the angle between their triangles, and a penalty for each fold, falls with each
/// flip. The noise of depth is larger than the spacing of rays in many scans, and then a raster has
/// many folds, fewer or more by the diagonals that are taken. The mesh has no fold as seen from the
/// sensor before and after. O(n) in practice.
/// \return number of flips
std::size_t
flipInView (TriangleMesh& mesh, const Rays& rays, const std::vector<Eigen::Vector3d>& positions,
            const ViewFlipLimits& limits, const RunContext& run);

} // namespace pcl::floater
