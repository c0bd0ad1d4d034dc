// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of the triangles of a chart in space, each laid flat.
#pragma once

#include "texture/chart_mesh.h"

namespace pcl::floater {
/// A triangle laid flat: map from the edges at its first corner to the unit vectors.
struct RestShape
{
  Eigen::Matrix2d to_unit; ///< inverse of the matrix whose columns are these two edges
  double area;
};

/// Minimum height over longest edge; thinner triangles are treated as if they had it. They are
/// noise of the sampling, and a layout with their shape would not survive rounding: at a length of
/// 1/1000 of the texture they have 100 steps of single precision.
constexpr double LEAST_HEIGHT = 0.01;

/// The shapes of all triangles of a chart, scaled to a total area of 1. Edges without length count
/// as LEAST_HEIGHT of the longest edge of the chart.
struct RestShapes
{
  std::vector<RestShape> shapes; ///< parallel to the triangles
  double area = 0.0;             ///< of all together before scaling, in the unit of the positions
};

/// O(triangles).
RestShapes
makeRestShapes (const ChartMesh& chart);

} // namespace pcl::floater
