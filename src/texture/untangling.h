// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Repairs projections in which small pieces are flipped or overlap.
#pragma once

#include "core/run_context.h"
#include "texture/chart_mesh.h"

namespace pcl::floater {
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
