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
/// INVALID_INDICES unless there is one cloud index for each position, each below the size of the
/// cloud and given once. O(n); one bit per point if they are not ascending.
Problem
checkInput (const Input& input);

/// A sensor position of (0, 0, 0) means: unknown.
bool
isSensorKnown (const std::array<double, 3>& sensor_origin);

/// INVALID_OPTION if the requested facing needs normals or a viewpoint that the input does not
/// have.
Problem
checkFacing (const Input& input, const Options& options);

/// Removes and reports gross outliers, if outliers are to be left out, and makes points that stand
/// for no measurement not finite. Points of the user's loop are kept.
/// \return DEGENERATE if a remaining point is too far from the others for double precision
Problem
cleanInput (Input& input, const Options& options, const Limits& limits, const RunContext& run,
            Report& report);

/// First step of a run: removes gross outliers and makes the working set. Frees each array of the
/// input after reading it.
Problem
takePoints (Input& input, const Request& request, Points& points, Report& report);

} // namespace pcl::floater
