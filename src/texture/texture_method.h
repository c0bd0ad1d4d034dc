// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Texture coordinates of a mesh: charts, their layout, the atlas.
#pragma once

#include "core/run_context.h"
#include "texture/atlas.h"
#include "texture/charts.h"
#include "texture/distortion_descent.h"
#include "texture/smoothing.h"

#include <pcl/surface/floater/texture_coordinates.h>

#include <vector>

namespace pcl::floater {
struct TextureLimits
{
  SmoothingLimits smoothing;
  ChartLimits charts;
  DescentLimits descent;
  AtlasLimits atlas;

  /// Stretch above which charts of the true surface are cut: roughness that is left after smoothing
  /// has less.
  double too_much = 1.5;

  /// Stretch of the true surface in the layout of the smoothed one, above which it is laid out
  /// without smoothing, if more than this share of the vertices was moved (otherwise above
  /// too_much). Generated planes, boxes and terrain with noise of up to three spacings stay below
  /// 3; thin parts that were flattened by smoothing do not.
  double wrong = 4.0;
  double noisy = 0.5;

  /// Steps of the descent on the true surface, after the smoothed one; limits the time, as noise
  /// prevents convergence.
  int steps_to_noise = 20;

  double half = 0.6; ///< share of the triangles in the larger half of a chart that is cut, at most

  /// Facets for cutting a chart: one for so many triangles, with a minimum. They decide the time of
  /// the search for each cut.
  std::size_t triangles_per_facet = 8;
  std::size_t facets_of_cut = 1'000;
};

/// Cuts a mesh into charts and lays them out, on all threads of the run.
/// \param mesh an oriented manifold; may have any number of components
/// \param smooth      positions without noise (smoothNoise)
/// \return the charts, in the order of their first triangles; each has a layout
std::vector<ChartLayout>
layOutCharts (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const std::vector<Eigen::Vector3d>& smooth, const TextureOptions& options,
              const TextureLimits& limits, const RunContext& run);

} // namespace pcl::floater
