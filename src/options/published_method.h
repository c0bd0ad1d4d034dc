// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The method of TW 385 and nothing else: what goes beyond it is turned off.
#pragma once

#include "options/stage_limits.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// The options with which a run works: those that are given, but for DiscOptions::as_published
/// without all that goes beyond TW 385.
Options
effectiveOptions (const Options& options);

/// The same for limits: with DiscOptions::as_published, tangent planes are those through all
/// neighbours (section 4.1).
Limits
effectiveLimits (const Limits& limits, const Options& options);

/// Sets what the report chose for a disc and the user did not: the boundary method, and for UMFPACK the ordering.
/// What is given stays: the report compares solvers and weights.
void
choosePublished (DiscOptions& disc, bool boundary_is_given, bool ordering_is_given);

} // namespace pcl::floater
