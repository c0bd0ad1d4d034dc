// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where a view has no rays: holes, shadows, and the outside of the view.
#pragma once

#include "mesh/triangle_mesh.h"
#include "view/rays.h"

#include <vector>

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
std::vector<std::uint8_t>
findGaps (const TriangleMesh& view, const Rays& rays, const GapLimits& limits,
          const RunContext& run);

} // namespace pcl::floater
