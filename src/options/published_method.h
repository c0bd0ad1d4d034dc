// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The method of TW 385 without any extension.
#pragma once

#include "options/stage_limits.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// The options of a run: as given, but with DiscOptions::as_published all extensions are turned
/// off.
Options
effectiveOptions (const Options& options);

/// The limits of a run: as given, but with DiscOptions::as_published tangent planes use all
/// neighbours (section 4.1).
Limits
effectiveLimits (const Limits& limits, const Options& options);

/// Sets the choices of TW 385 for a disc where the user gave none: the boundary method, and for
/// UMFPACK the ordering.
void
choosePublished (DiscOptions& disc, bool boundary_is_given, bool ordering_is_given);

} // namespace pcl::floater
