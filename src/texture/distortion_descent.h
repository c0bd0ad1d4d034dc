// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Evens out the distortion of a layout without flipping a triangle.
#pragma once

#include "core/run_context.h"
#include "texture/chart_mesh.h"
#include "texture/rest_shapes.h"

#include <vector>

namespace pcl::floater {
/// How long the descent goes on.
struct DescentLimits
{
  int steps = 60;                ///< at most
  double least_progress = 0.003; ///< of the distortion above its least by a step; below, it ends
  double enough = 4.3;           ///< distortion above which Newton's method follows: 4 is the least
  int newton_steps = 15;         ///< at most
  double least_newton_progress = 0.02; ///< as least_progress

  /// Of a chart: a step of Newton's method takes 6 microseconds for each. Where L-BFGS does not get
  /// on at all, such steps are made however many there are.
  std::size_t most_newton_triangles = 60'000;

  /// A chart of more triangles that cannot be begun as its projection gets no layout: it would
  /// begin on a circle, from where the descent takes long and does not come far. It is cut instead.
  std::size_t most_on_circle = 5'000;

  double safe_share = 0.8; ///< of the way to the first triangle without area
};

/// Moves all vertices, those of the boundary too, to lower the symmetric Dirichlet energy: the
/// integral over the chart of the squares of the singular values of the map and of its inverse (4
/// in all where lengths stay). It is infinite where a triangle has no area, and no step goes so
/// far: so no triangle is flipped (Smith and Schaefer 2015). The direction is that of a
/// quasi-Newton method (L-BFGS) which begins with the Laplacian of the shapes in space. That is
/// factorized once; a step takes 1 microsecond per triangle. Where that does not get on, some steps
/// of Newton's method follow.
///
/// The boundary is kept simple: the layout is the last one, of those looked at in between, whose
/// boundary does not cross itself.
/// \param[in,out] uv per vertex; no triangle flipped, the boundary simple. Scaled before anything
/// else
void
descendDistortion (const ChartMesh& chart, const RestShapes& rest, const DescentLimits& limits,
                   const RunContext& run, std::vector<Eigen::Vector2d>& uv);

/// Whether a closed polygon has no point twice. Exact; O(n log n).
bool
isSimple (const std::vector<Index>& loop, const std::vector<Eigen::Vector2d>& uv);

/// Whether all triangles run anti-clockwise in the plane. Exact.
bool
isUpright (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector2d>& uv);

} // namespace pcl::floater
