// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is taken out of a cloud before there is a working set.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "points/gross_outliers.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// Takes gross outliers out of the input and tells the report, if outliers are to be left out.
/// Points that the user's loop names stay.
/// \return DEGENERATE if a point stays that double precision cannot hold together with the others
Problem
cleanInput (Input& input, const Options& options, const GrossOutlierLimits& limits,
            const RunContext& run, Report& report);

} // namespace pcl::floater
