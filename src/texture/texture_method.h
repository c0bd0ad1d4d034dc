// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Texture coordinates of a mesh: charts, their layout, the atlas.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "texture/atlas.h"
#include "texture/distortion_descent.h"
#include "texture/facets.h"
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

  /// Largest ratio of the stretch of the pieces, above 1, to that of a chart with uniform stretch
  /// for which it is cut. The stretch by curvature falls to a quarter with half of the area; the
  /// stretch by roughness stays.
  double worthwhile = 0.7;

  /// A chart has uniform stretch if half of its area has at least this share of the mean stretch,
  /// above 1. For noise, with normals that scatter by 20 to 40 degrees, it is 0.4 and more; where a
  /// small piece sticks out, near 0.
  double even = 0.25;

  /// A chart with more stretch is always cut: roughness that is left after smoothing has less.
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

  /// How often the deviation of the pieces is halved, before a chart is cut in two.
  int halvings = 4;

  /// These, and the bounds below, were chosen by hand on two noisy scans, for few charts and little
  /// time; they do not decide whether a layout is right. A chart is cut in two if cutting by
  /// deviation gives more than 8 parts, or one part with more than 90 % of the triangles: curvature
  /// is then not the cause.
  std::size_t most_parts = 8;
  double largest_part = 0.9;
  double half = 0.6; ///< share of the triangles in the larger half, at most

  /// Facets for cutting a chart: one for so many triangles, with a minimum. They decide the time of
  /// the search for each cut.
  std::size_t triangles_per_facet = 8;
  std::size_t facets_of_cut = 1'000;
};

/// Cuts a mesh into charts and lays them out, on all threads of the run.
/// \param mesh an oriented manifold; may have any number of components
/// \param smooth      positions without noise (smoothNoise)
/// \param whole_discs components that are discs are not cut, whatever their stretch
/// \param largest_stretch mean stretch above which a chart is cut (see TextureOptions)
/// \return the charts, in the order of their first triangles; each has a layout
std::vector<ChartLayout>
layOutCharts (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              const std::vector<Eigen::Vector3d>& smooth, bool whole_discs, double largest_stretch,
              const TextureLimits& limits, const RunContext& run);

/// All steps. Sets everything except status and message.
/// \return the status and message: INVALID_INDICES or INVALID_OPTION for bad input
Problem
makeTextureCoordinates (const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Triangle>& triangles, const TextureOptions& options,
                        const TextureLimits& limits, const RunContext& run,
                        TextureCoordinates& result);

} // namespace pcl::floater
