// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Checks and cleaning of the input, and the points that a run works on.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "options/stage_limits.h"
#include "points/points.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// A sensor position of (0, 0, 0) means: unknown.
bool
isSensorKnown (const std::array<double, 3>& sensor_origin);

/// INVALID_OPTION if the requested facing needs normals or a viewpoint that are not given.
Problem
checkFacing (const Input& input, const Options& options);

/// First step of a run: checks input and options, removes and reports gross outliers, if outliers
/// are to be left out, makes points that stand for no measurement not finite, and makes the working
/// set. Points of the user's loop are kept. Frees each array of the input after reading it.
/// \return INVALID_INDICES unless there is one cloud index for each position, each below the size of
///     the cloud and given once; DEGENERATE if a remaining point is too far for double precision
Problem
takePoints (Input& input, const Options& options, const RunContext& run, Points& points,
            Report& report);

} // namespace pcl::floater
