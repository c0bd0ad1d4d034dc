// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps of a view, and the choice of its diagonals.
#pragma once

#include "mesh/triangle_mesh.h"
#include "view/rays.h"

namespace pcl::floater {
/// Marks the triangles of the view that lie in a gap. O(n).
/// \return of each triangle: 1 if it does
Flags
findGaps (const TriangleMesh& view, const Rays& rays, const RunContext& run);

/// Flips edges of the view to make the surface smoother. Each flip lowers the sum over the edges of
/// 1 - cosine of the angle between their triangles, plus a penalty for each fold. In many scans the
/// noise of depth exceeds the spacing of rays, and the number of folds depends on the diagonals.
/// From the sensor, the mesh never has a fold. The best flips come first. O(n) in practice, on all
/// threads.
/// \return number of flips
std::size_t
flipInView (TriangleMesh& mesh, const Rays& rays, const Positions& positions,
            const RunContext& run);

} // namespace pcl::floater
