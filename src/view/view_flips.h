// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps of a view, and the choice of its diagonals.
#pragma once

#include "mesh/triangle_mesh.h"
#include "view/rays.h"

namespace pcl::floater {
struct GapLimits
{
  double radius = 4.0; ///< circumradius of a triangle, over the typical one around it, above which
                       ///< it lies in a gap. A block of 4 by 4 missing rays in a raster has 3.5
                       ///< times the radius of its cells, one of 5 by 5 has 4.2. For random rays,
                       ///< two triangles in a thousand are as large
};

/// Marks the triangles of the view that lie in a gap. O(n).
/// \return of each triangle: 1 if it does
Flags
findGaps (const TriangleMesh& view, const Rays& rays, const GapLimits& limits,
          const RunContext& run);

struct ViewFlipLimits
{
  double angle = 90.0; ///< degrees by which the angles opposite to the new edge may exceed 180 in
                       ///< the view. On a raster it is 0: both diagonals of a cell are Delaunay
  double fold_cost = 5.0; ///< cost of a fold; an edge costs 1 - cosine of the angle between its
                          ///< triangles. The largest change of cost by an edge without a fold is
                          ///< 1.5, so a fold equals three of these
};

/// Flips edges of the view to make the surface smoother. Each flip lowers the sum over the edges of
/// 1 - cosine of the angle between their triangles, plus a penalty for each fold. In many scans the
/// noise of depth exceeds the spacing of rays, and the number of folds depends on the diagonals.
/// From the sensor, the mesh never has a fold. The best flips come first. O(n) in practice, on all
/// threads.
/// \return number of flips
std::size_t
flipInView (TriangleMesh& mesh, const Rays& rays, const Positions& positions,
            const ViewFlipLimits& limits, const RunContext& run);

} // namespace pcl::floater
