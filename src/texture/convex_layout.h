// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Convex-combination maps of a chart: every inner vertex is a weighted mean of its neighbours.
#pragma once

#include "core/run_context.h"
#include "texture/chart_mesh.h"

namespace pcl::floater {
/// Lays the boundary on a circle by the lengths of its edges, and every inner vertex by mean value
/// weights (Floater 2003). In exact arithmetic no triangle is flipped (Tutte 1963, Floater 1997).
/// Then lowers the stretch: divides weights by the stretch around the neighbour (Yoshizawa,
/// Belyaev, Seidel 2004) while the stretch falls, which keeps them positive. One sparse linear
/// system for each step, some 5 in total.
/// \param chart a disc
/// \return per vertex; empty if rounding or the solver failed
std::vector<Eigen::Vector2d>
layOutOnCircle (const ChartMesh& chart, const RestShapes& rest, const RunContext& run);

/// Moves the vertices of flipped triangles, and those around them, to the mean of their neighbours
/// (at the boundary, of those along it). All others stay. O(triangles) for each round.
/// \param[in,out] uv per vertex; valid only after success
/// \return whether, in double precision, nothing is flipped
bool
untangle (const ChartMesh& chart, const RunContext& run, std::vector<Eigen::Vector2d>& uv);

} // namespace pcl::floater
