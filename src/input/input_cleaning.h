// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cleaning of the input before the working set is made.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "points/gross_outliers.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// Removes and reports gross outliers, if outliers are to be left out. Points of the user's loop
/// are kept.
/// \return DEGENERATE if a remaining point is too far from the others for double precision
Problem
cleanInput (Input& input, const Options& options, const GrossOutlierLimits& limits,
            const RunContext& run, Report& report);

} // namespace pcl::floater
