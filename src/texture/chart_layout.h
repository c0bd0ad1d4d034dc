// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Lays one chart out in the plane.
#pragma once

#include "core/run_context.h"
#include "texture/distortion_descent.h"

#include <array>
#include <vector>

namespace pcl::floater {
/// A chart in the plane.
struct ChartLayout
{
  std::vector<Index> triangles;    ///< of the mesh, ascending
  std::vector<Index> points;       ///< of the mesh, ascending
  std::vector<Triangle> corners;   ///< parallel to triangles: places in `points`
  std::vector<Index> loop;         ///< places in `points` of the boundary in order, the chart left
  std::vector<Eigen::Vector2d> uv; ///< parallel to points, of any scale; empty if the chart is no
                                   ///< disc, or rounding failed
  double area = 0.0;    ///< of the chart in space, where thin triangles count more (LEAST_HEIGHT)
  double stretch = 1.0; ///< mean (see StretchSums)
  double median_stretch = 1.0; ///< that half of the area exceeds
};

/// Lays a chart out without a flipped triangle, and with a boundary that does not cross itself: so
/// that no point of the plane is taken twice. It begins with the projection on the plane to which
/// the chart faces, if that is such a layout; else with convex combinations within the projection
/// of the boundary; else with those on a circle (layOutOnCircle). Then it evens the distortion out
/// (descendDistortion). Both properties are checked exactly. Takes 10 microseconds per triangle
/// from a projection, and some 100 from a circle.
/// \param triangles of the mesh
/// \param chart     triangles of the chart, ascending
/// \param positions of the points of the mesh
ChartLayout
layOutChart (const std::vector<Triangle>& triangles, std::vector<Index> chart,
             const std::vector<Eigen::Vector3d>& positions, const DescentLimits& limits,
             const RunContext& run);

/// Evens out the distortion of a layout with regard to other positions than those that it was made
/// for: without their noise. It stays as it is if that does not lower its stretch.
/// \param[in,out] layout one that has coordinates
/// \return whether it was changed; then its figures are those of these positions
bool
refineLayout (const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& positions,
              const DescentLimits& limits, const RunContext& run, ChartLayout& layout);

} // namespace pcl::floater
