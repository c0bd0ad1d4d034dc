// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Convex-combination maps of a chart: every inner vertex is a weighted mean of its neighbours.
#pragma once

#include "core/run_context.h"
#include "texture/chart_mesh.h"

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

/// Limits of the repair.
struct UntanglingLimits
{
  int rounds = 60; ///< maximum; remaining defects are wider than 30 triangles and no details

  /// Moved are the bad vertices and some rings around them: one, plus one after this many rounds. A
  /// patch by means of neighbours is upright if the polygon around it is convex (Tutte 1963); a
  /// wider patch mostly has a better one.
  int rounds_per_ring = 4;

  int sweeps = 4; ///< over these vertices in a round

  /// Share of flipped triangles above which the whole is flipped, not a detail.
  double most_flipped = 0.2;
};

/// Moves the vertices of flipped triangles and of crossing boundary edges, and those around them,
/// to the mean of their neighbours (at the boundary, of those along it): tangles are undone and
/// loops of the boundary shrink to nothing. All others stay. O(triangles) for each round.
/// \param[in,out] uv per vertex; valid only after success
/// \return whether, in double precision, nothing is flipped and no boundary edges cross
bool
untangle (const ChartMesh& chart, const UntanglingLimits& limits, const RunContext& run,
          std::vector<Eigen::Vector2d>& uv);

} // namespace pcl::floater
