// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Limits: the parameters of the stages that are no options, but may be set (documented there).
#pragma once

#include "consensus/consensus_method.h"
#include "core/run_context.h"
#include "view/view_method.h"

namespace pcl::floater {
struct Limits
{
  RepairLimits repair;
  ViewLimits view;
};

struct Request
{
  const Options& options;
  const Limits& limits;
  const RunContext& run;
  std::array<double, 3> sensor_origin{}; ///< as in Input
  std::array<double, 3> origin{};        ///< where it was before Input::shift
};

/// Whether folds and self-intersections are repaired.
inline bool
repairsFlaws (const Options& options)
{
  return options.flip_edges && options.remove_self_intersections;
}

/// Whether the disc method is asked for.
inline bool
asksForDisc (const Options& options)
{
  return options.topology == Topology::DISC || !options.disc.boundary.loop.empty ();
}

/// Settings for the stars of the points.
inline StarSettings
starSettings (const Options& options)
{
  StarSettings settings;
  settings.filter_sheets = options.filter_sheets;
  settings.with_offsets = asksForDisc (options);
  settings.reach_beyond = !asksForDisc (options) && !isInBalls (options.neighbors.kind);
  settings.planes_of_all = options.disc.as_published;
  return settings;
}

/// Whether the cloud may be connected as its sensor saw it.
inline bool
mayBeSeen (const Options& options)
{
  return !asksForDisc (options) && options.view.use != ViewUse::NEVER;
}

} // namespace pcl::floater
