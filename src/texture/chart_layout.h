// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Lays charts out in the plane, and packs them into the unit square.
#pragma once

#include "core/run_context.h"
#include "texture/chart_mesh.h"

namespace pcl::floater {
/// A chart in the plane.
struct ChartLayout
{
  std::vector<Index> triangles; ///< of the mesh, ascending
  MeshPiece chart;              ///< these triangles, in this order
  std::vector<Vector2d> uv;     ///< per vertex, any scale; empty if no disc, or rounding failed
  double area = 0.0;            ///< of the chart in space, with minimum heights (LEAST_HEIGHT)
  double stretch = 1.0;         ///< mean (see StretchSums)
};

/// Limits of the descent.
struct DescentLimits
{
  int steps = 60;                ///< at most
  double least_progress = 0.003; ///< of a step, relative to the distortion above its minimum
  int newton_steps = 15;         ///< at most

  /// Largest chart that may start on a circle, from where the descent is slow and ends early. A
  /// larger one without valid projection gets no layout, and is cut.
  std::size_t most_on_circle = 5'000;
};

/// Lays the boundary on a circle by the lengths of its edges, and every inner vertex at the mean of its
/// neighbours. In exact arithmetic no triangle is flipped (Tutte 1963, Floater 1997).
/// Then lowers the stretch: divides weights by the stretch around the neighbour (Yoshizawa,
/// Belyaev, Seidel 2004) while the stretch falls. Some 5 steps, each a sparse linear system.
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

/// Moves all vertices, the boundary included, to lower the symmetric Dirichlet energy: the integral
/// over the chart of the squared singular values of the map and of its inverse (4 if isometric). It
/// is infinite where a triangle has no area, and no step goes so far: so no triangle is flipped
/// (Smith and Schaefer 2015). The direction is the gradient with regard to the Laplacian of the shapes
/// in space, factorized once; a step takes 1 microsecond per triangle. Without progress, some steps
/// of Newton's method follow. (A quasi-Newton method, L-BFGS, ends higher.) The result is the last
/// tested layout whose boundary does not cross itself.
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

/// Lays a chart out without flipped triangles, and with a simple boundary: no point of the plane is
/// covered twice. Starts with the projection along the mean normal, untangled if it has small
/// defects, or else on a circle (layOutOnCircle); one triangle with its shape in space. Then lowers
/// the distortion (descendDistortion). Both properties are tested exactly. Takes 10 microseconds per
/// triangle from a projection, and some 100 from a circle.
/// \param triangles, positions of the mesh
/// \param chart its triangles, ascending
ChartLayout
layOutChart (const std::vector<Triangle>& triangles, std::vector<Index> chart,
             const Positions& positions, const DescentLimits& limits, const RunContext& run);

/// Lowers the distortion of a layout for other positions than its own: for the surface with its
/// noise. Keeps the coordinates if that does not lower its stretch.
/// \param[in,out] layout with coordinates; its figures are then for these positions
void
refineLayout (const Positions& positions, const DescentLimits& limits, const RunContext& run,
              ChartLayout& layout);

/// Scales every chart to an area proportional to its area in space times its stretch (if that is at
/// most 1000), which minimizes the total stretch, and to a length of a sixteenth of a cell to 4
/// squares; rotates it to the smallest box; and packs all into the unit square,
/// largest first, each in one of four directions, at the lowest free position. Free are cells that
/// no triangle touches. The coordinates are then in the square. O(triangles + charts cells^2).
/// \param[in,out] charts laid out, none empty
/// \return least distance of two charts, in sides of the square; half of it at the border. Charts of
///     about one cell may be nearer by rounding
double
packCharts (std::vector<ChartLayout>& charts, const RunContext& run);

} // namespace pcl::floater
