// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Convex-combination maps of a chart: every inner vertex is a weighted mean of its neighbours.
#pragma once

#include "core/run_context.h"
#include "texture/chart_mesh.h"
#include "texture/rest_shapes.h"

namespace pcl::floater {
/// A layout in the plane, if any.
struct PlaneLayout
{
  std::vector<Eigen::Vector2d> uv; ///< per vertex; empty if there is no layout
};

/// Lays the boundary on a circle by the lengths of its edges, and every inner vertex by mean value
/// weights (Floater 2003). In exact arithmetic no triangle is flipped (Tutte 1963, Floater 1997).
/// Then lowers the stretch: divides weights by the stretch around the neighbour (Yoshizawa,
/// Belyaev, Seidel 2004) while the stretch falls, which keeps them positive. One sparse linear
/// system for each step, some 5 in total.
/// \param chart a disc
/// \return nothing if rounding or the solver failed
PlaneLayout
layOutOnCircle (const ChartMesh& chart, const RestShapes& rest, const RunContext& run);

/// Keeps the boundary, and lays every inner vertex by mean value weights. If the boundary is not
/// convex, triangles may be flipped.
/// \param[in,out] uv per vertex; reads the boundary, sets the others
/// \return false if the solver failed
bool
layOutWithin (const ChartMesh& chart, const RunContext& run, std::vector<Eigen::Vector2d>& uv);

} // namespace pcl::floater
