// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the options, warnings of those without effect, and the choices of TW 385.
#pragma once

#include "core/problem.h"
#include "options/stage_limits.h"

#include <pcl/surface/floater/options.h>
#include <pcl/surface/floater/report.h>

#include <string>

namespace pcl::floater {
/// The options of a run: as given, but without any extension for DiscOptions::as_published.
Options
effectiveOptions (const Options& options);

/// Sets the boundary method of TW 385, and for UMFPACK its ordering, where the user gave none.
void
choosePublished (DiscOptions& disc, bool boundary_is_given, bool ordering_is_given);

/// INVALID_OPTION if an option is out of its range, the solver does not take the ordering, or the
/// hole policy or a given loop does not fit the topology. INVALID_LOOP if the given loop has fewer
/// than three points.
Problem
checkOptions (const Options& options);

/// One sentence for each reason why options that differ from the default had no effect.
/// \param report of the run, for the method that made the mesh
/// \param has_plane_normals normals were given for the tangent planes
std::vector<std::string>
describeUnusedOptions (const Options& options, const Report& report,
                       bool has_plane_normals = false);

} // namespace pcl::floater
