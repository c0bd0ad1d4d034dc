// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Repairs a projection of which small parts are upside down or lie on others.
#pragma once

#include "core/run_context.h"
#include "texture/chart_mesh.h"

namespace pcl::floater {
/// When the repair is given up.
struct UntanglingLimits
{
  int rounds = 60; ///< at most; what is left then is wider than 30 triangles and no detail

  /// The vertices that are moved are those that were bad and so many rings around them: one, and
  /// one more after each so many rounds. A patch that is laid by means of neighbours is upright if
  /// the polygon around it is convex (Tutte 1963); a wider patch mostly has a better one.
  int rounds_per_ring = 4;

  int sweeps = 4; ///< over these vertices in a round

  /// Share of triangles that are upside down above which the whole is, and not a detail of it.
  double most_flipped = 0.2;
};

/// Moves the vertices of triangles that are upside down, those of boundary edges that cross each
/// other, and those around them to the mean of their neighbours, on the boundary of those along it:
/// tangles come undone and loops of the boundary shrink to nothing. All others stay. O(triangles)
/// for each round.
/// \param[in,out] uv per vertex
/// \return whether, in double precision, nothing is left that is upside down or crosses; uv is of
///         use only then
bool
untangle (const ChartMesh& chart, const UntanglingLimits& limits, const RunContext& run,
          std::vector<Eigen::Vector2d>& uv);

} // namespace pcl::floater
