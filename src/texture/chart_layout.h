// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Lays one chart out in the plane.
#pragma once

#include "core/run_context.h"
#include "texture/distortion_descent.h"

namespace pcl::floater {
/// A chart in the plane.
struct ChartLayout
{
  std::vector<Index> triangles; ///< of the mesh, ascending
  MeshPiece chart;              ///< these triangles, in this order
  std::vector<Vector2d> uv;     ///< per vertex, of any scale; empty if the chart is no disc, or
                                ///< rounding failed
  double area = 0.0;            ///< of the chart in space, with minimum heights (LEAST_HEIGHT)
  double stretch = 1.0;         ///< mean (see StretchSums)
};

/// Lays the boundary on a circle by the lengths of its edges, and every inner vertex at the mean of its
/// neighbours. In exact arithmetic no triangle is flipped (Tutte 1963, Floater 1997).
/// Then lowers the stretch: divides weights by the stretch around the neighbour (Yoshizawa,
/// Belyaev, Seidel 2004) while the stretch falls, which keeps them positive. One sparse linear
/// system for each step, some 5 in total.
/// \param chart a disc
/// \return per vertex; empty if rounding or the solver failed
std::vector<Vector2d>
layOutOnCircle (const MeshPiece& chart, const RunContext& run);

/// Moves the vertices of flipped triangles, and those around them, to the mean of their neighbours
/// (at the boundary, of those along it). All others stay. O(triangles) for each round.
/// \param[in,out] uv per vertex; valid only after success
/// \return whether, in double precision, nothing is flipped
bool
untangle (const MeshPiece& chart, const RunContext& run, std::vector<Vector2d>& uv);

/// Lays a chart out without flipped triangles, and with a simple boundary: no point of the plane is
/// covered twice. Starts with the projection along the mean normal, untangled if it has small
/// defects, or else on a circle (layOutOnCircle); one triangle with its shape in space. Then lowers
/// the distortion (descendDistortion). Both properties are tested exactly. Takes 10 microseconds per
/// triangle from a projection, and some 100 from a circle.
/// \param triangles of the mesh
/// \param chart     triangles of the chart, ascending
/// \param positions of the points of the mesh
ChartLayout
layOutChart (const std::vector<Triangle>& triangles, std::vector<Index> chart,
             const Positions& positions, const DescentLimits& limits, const RunContext& run);

/// Lowers the distortion of a layout for other positions than its own: for the surface with its
/// noise. Keeps the coordinates if that does not lower its stretch.
/// \param[in,out] layout with coordinates; its figures are then for these positions
void
refineLayout (const Positions& positions, const DescentLimits& limits, const RunContext& run,
              ChartLayout& layout);

} // namespace pcl::floater
