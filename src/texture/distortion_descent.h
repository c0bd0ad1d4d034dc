// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Lowers the distortion of a layout without flipping a triangle.
#pragma once

#include "core/run_context.h"
#include "texture/chart_mesh.h"

namespace pcl::floater {
/// Limits of the descent.
struct DescentLimits
{
  int steps = 60;                ///< at most
  double least_progress = 0.003; ///< relative decrease of the distortion above its minimum by a
                                 ///< step; below, it ends
  double enough = 4.3;           ///< distortion above which Newton's method follows; the minimum is
                                 ///< 4
  int newton_steps = 15;         ///< at most
  double least_newton_progress = 0.02; ///< as least_progress

  /// Largest chart that may start on a circle, from where the descent is slow and ends early. A
  /// larger one without valid projection gets no layout, and is cut.
  std::size_t most_on_circle = 5'000;

  double safe_share = 0.8; ///< of the step to the first triangle without area
};

/// Moves all vertices, the boundary included, to lower the symmetric Dirichlet energy: the integral
/// over the chart of the squared singular values of the map and of its inverse (4 if isometric). It
/// is infinite where a triangle has no area, and no step goes so far: so no triangle is flipped
/// (Smith and Schaefer 2015). The direction is the gradient with regard to the Laplacian of the shapes
/// in space, factorized once; a step takes 1 microsecond per triangle. Without progress, some steps
/// of Newton's method follow. (A quasi-Newton method, L-BFGS, ends higher.)
///
/// The boundary stays simple: the result is the last tested layout whose boundary does not cross
/// itself.
/// \param[in,out] uv per vertex; no triangle flipped, the boundary simple. Scaled first
void
descendDistortion (const MeshPiece& chart, const RestShapes& rest, const DescentLimits& limits,
                   const RunContext& run, std::vector<Vector2d>& uv);

/// Whether a closed polygon is simple. Exact; O(n log n).
bool
isSimple (const std::vector<Index>& loop, const std::vector<Vector2d>& uv);

/// Whether all triangles are anti-clockwise in the plane. Exact.
bool
isUpright (const std::vector<Triangle>& triangles, const std::vector<Vector2d>& uv);

} // namespace pcl::floater
