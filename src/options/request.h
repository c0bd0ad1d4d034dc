// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Options and run of a reconstruction.
#pragma once

#include "core/run_context.h"
#include "options/stage_limits.h"

#include <array>

namespace pcl::floater {
struct Request
{
  const Options& options;
  const Limits& limits;
  const RunContext& run;
  std::array<double, 3> sensor_origin{}; ///< as in Input
};

/// Whether the disc method is asked for.
inline bool
asksForDisc (const Options& options)
{
  return options.topology == Topology::DISC || !options.disc.boundary.loop.empty ();
}

/// Whether the cloud may be connected as its sensor saw it.
inline bool
mayBeSeen (const Options& options)
{
  return !asksForDisc (options) && options.view.use != ViewUse::NEVER;
}

} // namespace pcl::floater
