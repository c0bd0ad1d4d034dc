// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps and depth steps of a view, and the choice of its diagonals.
#pragma once

#include "mesh/triangle_mesh.h"
#include "view/rays.h"

namespace pcl::floater {
/// Marks the triangles of the view that lie in a gap. O(n).
/// \return of each triangle: 1 if it does
Flags
findGaps (const TriangleMesh& view, const Rays& rays, const RunContext& run);

/// Marks triangles at edges of the view that lead from one surface to another behind it.
///
/// From each end of an edge, the surface is extrapolated along the edge: inverse depths (see Rays)
/// are affine in planes, so the triangle behind the end predicts the inverse depth at the other
/// end. An edge is a step if it is steep, and if neither end predicts the other one: the deviation
/// exceeds the noise, and the surface is not as steep in this direction. But where it goes the same
/// way at both ends, steeply and beyond the noise, few rays hit it, such as ground far away.
///
/// Noise grows with depth. It is a quantile of the deviations, divided by their sums of weights, at
/// edges of about the same depth; or one quantum, where most deviations are rounding. O(n log n).
/// \return of each triangle: 1 if one of its edges is a step
Flags
findDepthSteps (const TriangleMesh& view, const Rays& rays, const RunContext& run);

/// Flips edges of the view to make the surface smoother. Each flip lowers the sum over the edges of
/// 1 - cosine of the angle between their triangles, plus a penalty for each fold. In many scans the
/// noise of depth exceeds the spacing of rays, and the number of folds depends on the diagonals.
/// From the sensor, the mesh never has a fold. O(n) in practice, on all threads.
/// \return number of flips
std::size_t
flipInView (TriangleMesh& mesh, const Rays& rays, const Positions& positions,
            const RunContext& run);

} // namespace pcl::floater
